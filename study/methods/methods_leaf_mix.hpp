#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/methods/early_exits.hpp"
#include "model/workload.hpp"
#include "study/methods/methods_bench.hpp"

namespace rtu::study {

/// A ray and the triangles that its traversal tests, in that order: what a leaf test meets in use.
struct RayLeaves {
    model::Ray ray;
    std::vector<model::methods::Corners> triangles;
    std::vector<float> t_max;  ///< [triangles.size()] where the ray ended when the triangle's turn came
};

/// What each half of Shevtsov's test rejects on these rays, which end where they ended in their traversal.
[[nodiscard]] model::methods::EarlyExits early_exits(std::span<const RayLeaves> mix);

/// A sample of at most `ray_count` of the workload's rays, one of each stretch of equal length; rays that
/// test no triangle are left out.
[[nodiscard]] std::vector<RayLeaves> leaf_mix(const model::TriangleMesh& mesh,
                                              const model::MemoryImage& image,
                                              const model::Workload& workload, std::uint32_t ray_count,
                                              std::uint64_t seed);

/// The same, pair by pair: triangles 2i and 2i + 1 are a pair of the image that the ray tests. Lone triangles
/// are left out.
[[nodiscard]] std::vector<RayLeaves> pair_mix(const model::MemoryImage& image,
                                              const model::Workload& workload, std::uint32_t ray_count,
                                              std::uint64_t seed);

/// Speeds of the kernels on each ray's own triangles, ray set-up included. Packets are left out: their rays
/// would have to visit the same leaves. `workload` names the rows.
[[nodiscard]] std::vector<MethodsRow> measure_leaf_mix(std::span<const model::methods::Kernel> kernels,
                                                       std::span<const RayLeaves> singles,
                                                       std::span<const RayLeaves> pairs,
                                                       const std::string& workload, std::uint32_t repeats,
                                                       const MethodsProgress& progress);

}  // namespace rtu::study
