#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "tests/model/gltf_builder.hpp"
#include "tests/model/meshes.hpp"
#include "traces/trace_reader.hpp"
#include "traces/trace_writer.hpp"
#include "traces/visit_recorder.hpp"

namespace rtu::test {

inline std::string bytes_of(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// Rays with every kind of number: small, large, infinite, not a number, both zeros.
inline std::vector<model::Ray> odd_rays(std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    const float infinity = std::numeric_limits<float>::infinity();
    const float odd[] = {0.0F, -0.0F, infinity, -infinity, 1e-45F, 3.4e38F, 0.1F, 16777216.0F};
    std::vector<model::Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        model::Ray ray{random.point(-9, 9), random.uniform(0, 1), random.point(-1, 1), infinity};
        if (i % 5 == 0) ray.origin[i % 3] = odd[random.below(8)];
        if (i % 7 == 0) ray.t_max = odd[random.below(8)];
        rays.push_back(ray);
    }
    return rays;
}

/// Three workloads: with pixels, with parents, and without a ray.
inline std::vector<traces::RayChunk> example_chunks(std::uint32_t rays_a, std::uint32_t rays_b) {
    std::vector<traces::RayChunk> chunks{
        {"primary", model::RayKind::ClosestHit, traces::IdKind::Pixel, 0, odd_rays(rays_a, 1), {}},
        {"shadow", model::RayKind::AnyHit, traces::IdKind::Parent, 0, odd_rays(rays_b, 2), {}},
        {"none", model::RayKind::AnyHit, traces::IdKind::None, 0, {}, {}}};
    for (std::uint32_t i = 0; i < rays_a; ++i) chunks[0].ids.push_back(3 * i);
    for (std::uint32_t i = 0; i < rays_b; ++i) chunks[1].ids.push_back(~i);
    return chunks;
}

inline traces::TraceHeader example_header() {
    traces::TraceHeader header = traces::header_of_rays("a test");
    header.scene_hash = 0x1234;
    header.scene_name = "scene";
    header.picture = {{640, 480}, {{1, 2, 3}, {4, 5, 6}, {0, 1, 0}, 0.5F}, "camera.toml", 77};
    return header;
}

inline void write_trace(const std::filesystem::path& path, const std::vector<traces::RayChunk>& chunks) {
    traces::TraceWriter writer(path, example_header());
    for (const traces::RayChunk& chunk : chunks) writer.add(chunk);
    writer.finish();
}

/// All rays of a trace, a chunk for each workload.
inline std::vector<traces::RayChunk> read_trace(const std::filesystem::path& path) {
    traces::TraceReader reader(path);
    std::vector<traces::RayChunk> workloads;
    while (const auto chunk = reader.next_rays()) {
        if (workloads.empty() || workloads.back().workload != chunk->workload) {
            workloads.push_back(*chunk);
            continue;
        }
        traces::RayChunk& whole = workloads.back();
        whole.rays.insert(whole.rays.end(), chunk->rays.begin(), chunk->rays.end());
        whole.ids.insert(whole.ids.end(), chunk->ids.begin(), chunk->ids.end());
    }
    return workloads;
}

/// Equal to the bit; NaN equals NaN.
inline bool is_same(const model::Ray& a, const model::Ray& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline void expect_equal(const std::vector<traces::RayChunk>& a, const std::vector<traces::RayChunk>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].workload, b[k].workload);
        EXPECT_EQ(a[k].kind, b[k].kind);
        EXPECT_EQ(a[k].id_kind, b[k].id_kind);
        EXPECT_EQ(a[k].ids, b[k].ids);
        ASSERT_EQ(a[k].rays.size(), b[k].rays.size()) << a[k].workload;
        for (std::size_t i = 0; i < a[k].rays.size(); ++i) {
            ASSERT_TRUE(is_same(a[k].rays[i], b[k].rays[i])) << a[k].workload << " ray " << i;
        }
    }
}

/// What an error says, or nothing when there is none.
template <class F>
std::string error_of(F f) {
    try {
        f();
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace rtu::test
