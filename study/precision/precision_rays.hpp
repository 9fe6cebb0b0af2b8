#pragma once

#include <cstdint>
#include <vector>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/methods/method.hpp"
#include "model/workload.hpp"

namespace rtu::study {

/// A ray and the triangles that it is to be tested against, in that order.
struct RayTriangles {
    model::Ray ray;
    std::vector<model::methods::Corners> triangles;
};

/// At most `ray_count` rays of the workload, one of each stretch of equal length, with the triangles that its
/// reference traversal tests. A ray that tests none stays: it hits nothing, whatever the arithmetic.
[[nodiscard]] std::vector<RayTriangles> sampled_rays(const model::TriangleMesh& mesh,
                                                     const model::MemoryImage& image,
                                                     const model::Workload& workload, std::uint32_t ray_count,
                                                     std::uint64_t seed);

/// Rays from the origins of the workload's rays, at most `ray_count`, at the vertices (every second) and the
/// edges of the triangles that those hit, each with all triangles around that vertex, or around both ends of
/// that edge. Corners are one vertex where their positions are bit-equal. Left out are rays at the surface's
/// border, and where its triangles are not all seen from one side: elsewhere a hit is owed.
[[nodiscard]] std::vector<RayTriangles> aimed_rays(const model::TriangleMesh& mesh,
                                                   const model::MemoryImage& image,
                                                   const model::Workload& workload, std::uint32_t ray_count,
                                                   std::uint64_t seed);

}  // namespace rtu::study
