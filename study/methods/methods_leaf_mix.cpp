#include "study/methods/methods_leaf_mix.hpp"

#include <algorithm>
#include <limits>

#include "model/random.hpp"
#include "model/traversal.hpp"

namespace rtu::study {

namespace {

using model::methods::Corners;
using model::methods::Form;
using model::methods::Kernel;
using model::methods::PreparedTriangles;
using model::methods::RayResult;

constexpr std::uint32_t for_sample = 0x7263;

// Calls `take` with each pair that the ray tests, and where the ray ends by then.
template <class Take>
void walk(const model::MemoryImage& image, const model::Ray& ray, model::RayKind kind, Take take) {
    model::Traversal traversal;
    if (!start(traversal, image, ray, kind)) return;
    do {
        const model::NodeRef ref = traversal.current.ref;
        if (!ref.is_leaf()) {
            visit_node(traversal, image);
            continue;
        }
        for (std::uint32_t i = 0; i < ref.pair_count() && !is_satisfied(traversal); ++i) {
            take(image.leaf_pair(ref, i), traversal.closest.hit.t);
            visit_pair(traversal, image, i);
        }
    } while (!is_satisfied(traversal) && pop(traversal));
}

template <class Take>
std::vector<RayLeaves> sample(const model::MemoryImage& image, const model::Workload& workload,
                              std::uint32_t ray_count, std::uint64_t seed, Take take) {
    std::vector<RayLeaves> mix;
    const std::size_t count = std::min<std::size_t>(ray_count, workload.rays.size());
    for (std::size_t i = 0; i < count; ++i) {
        // One ray of each stretch: a fixed stride would walk down a column of the picture.
        const std::size_t begin = i * workload.rays.size() / count;
        const std::size_t end = (i + 1) * workload.rays.size() / count;
        model::RandomStream random(seed, for_sample, std::uint32_t(i));
        RayLeaves one{workload.rays[begin + std::size_t(random.next() * float(end - begin))], {}, {}};
        walk(image, one.ray, workload.ray_kind, [&](const model::LeafPair& pair, float t_max) {
            take(pair, one.triangles);
            one.t_max.resize(one.triangles.size(), t_max);
        });
        if (!one.triangles.empty()) mix.push_back(std::move(one));
    }
    return mix;
}

struct MixCandidate {
    Kernel kernel;
    std::vector<PreparedTriangles> triangles;
    std::uint64_t tests = 0, hit_rays = 0;
    double least_seconds = std::numeric_limits<double>::infinity();
};

MixCandidate prepared(const Kernel& kernel, std::span<const RayLeaves> mix) {
    MixCandidate one{.kernel = kernel, .triangles = {}};
    for (const RayLeaves& leaves : mix) {
        kernel.store(leaves.triangles, one.triangles.emplace_back());
        one.tests += leaves.triangles.size();
    }
    return one;
}

void time_once(std::span<const RayLeaves> mix, MixCandidate& one) {
    one.hit_rays = 0;
    const double begin = thread_cpu_seconds();
    for (std::size_t i = 0; i < mix.size(); ++i) {
        RayResult result;
        one.kernel.trace(one.triangles[i], {&mix[i].ray, 1}, true, {&result, 1});
        one.hit_rays += result.hit_count > 0 ? 1 : 0;
    }
    one.least_seconds = std::min(one.least_seconds, thread_cpu_seconds() - begin);
}

}  // namespace

std::vector<RayLeaves> leaf_mix(const model::TriangleMesh& mesh, const model::MemoryImage& image,
                                const model::Workload& workload, std::uint32_t ray_count,
                                std::uint64_t seed) {
    const auto corners = [&](std::uint32_t id) {
        const model::Triangle& t = mesh.triangles[id];
        return Corners{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    };
    return sample(image, workload, ray_count, seed,
                  [&](const model::LeafPair& pair, std::vector<Corners>& triangles) {
                      triangles.push_back(corners(pair.primitive_ids[0]));
                      if (pair.has_second()) triangles.push_back(corners(pair.primitive_ids[1]));
                  });
}

std::vector<RayLeaves> pair_mix(const model::MemoryImage& image, const model::Workload& workload,
                                std::uint32_t ray_count, std::uint64_t seed) {
    return sample(image, workload, ray_count, seed,
                  [](const model::LeafPair& pair, std::vector<Corners>& triangles) {
                      if (!pair.has_second()) return;
                      const auto& v = pair.vertices;
                      triangles.push_back({v[0], v[1], v[2]});
                      triangles.push_back({v[0], v[2], v[3]});
                  });
}

model::methods::EarlyExits early_exits(std::span<const RayLeaves> mix) {
    std::vector<model::Ray> rays;
    std::vector<Corners> triangles;
    for (const RayLeaves& leaves : mix)
        for (std::size_t i = 0; i < leaves.triangles.size(); ++i) {
            rays.push_back(leaves.ray);
            rays.back().t_max = leaves.t_max[i];
            triangles.push_back(leaves.triangles[i]);
        }
    return model::methods::count_early_exits(rays, triangles);
}

std::vector<MethodsRow> measure_leaf_mix(std::span<const Kernel> kernels, std::span<const RayLeaves> singles,
                                         std::span<const RayLeaves> pairs, const std::string& workload,
                                         std::uint32_t repeats, const MethodsProgress& progress) {
    const auto mix_of = [&](const Kernel& kernel) { return kernel.form == Form::Pairs ? pairs : singles; };
    std::vector<MixCandidate> candidates;
    for (const Kernel& kernel : kernels)
        if (kernel.form != Form::Rays && !mix_of(kernel).empty())
            candidates.push_back(prepared(kernel, mix_of(kernel)));
    for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
        for (MixCandidate& one : candidates) time_once(mix_of(one.kernel), one);
        progress(double(repeat + 1) / repeats);
    }
    std::vector<MethodsRow> rows;
    for (const MixCandidate& one : candidates)
        rows.push_back({.kernel = one.kernel,
                        .workload = workload,
                        .tests_per_second = double(one.tests) / one.least_seconds,
                        .first_pass_tests_per_second = std::nullopt,
                        .worst_tests_per_second = std::nullopt,
                        .precompute_triangles_per_second = std::nullopt,
                        .tests = one.tests,
                        .hit_share = double(one.hit_rays) / double(mix_of(one.kernel).size())});
    return rows;
}

}  // namespace rtu::study
