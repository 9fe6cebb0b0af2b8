#pragma once

#include <cstdint>
#include <vector>

#include "model/methods/method.hpp"
#include "model/ray.hpp"

namespace rtu::study {

/// Rays and triangles, each ray to be tested against every triangle. Triangles 2i and 2i + 1 are (a, b, c)
/// and (a, c, d).
struct MethodsWorkload {
    std::vector<model::methods::Corners> triangles;
    std::vector<model::Ray> rays;
};

/// The workload of [HH11], after [KS06]: a, b, c uniform in the unit cube, rays from one uniform point of it
/// towards another, t in (0, infinity). Their generator is not published; this one is ours. d completes a, b,
/// c to a parallelogram but for a tenth of the cube, so that pairs are shaped like those of meshes.
/// `triangle_count` is even. The same numbers on every machine.
[[nodiscard]] MethodsWorkload random_methods_workload(std::uint32_t triangle_count, std::uint32_t ray_count,
                                                      std::uint64_t seed);

}  // namespace rtu::study
