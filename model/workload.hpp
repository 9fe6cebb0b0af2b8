#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/camera.hpp"
#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/ray.hpp"

namespace rtu::model {

enum class WorkloadKind : std::uint8_t { Primary, Shadow, AmbientOcclusion, Diffuse, Random };

/// Throws Error, listing the known names, for anything but primary, shadow, ao, diffuse, random.
[[nodiscard]] WorkloadKind parse_workload_kind(std::string_view text);
[[nodiscard]] std::string_view to_string(WorkloadKind kind);

/// Rays of one kind, in the order in which they are handed to the machine.
struct Workload {
    std::string name;
    RayKind ray_kind = RayKind::ClosestHit;
    std::vector<Ray> rays;
    std::vector<std::uint32_t> pixels;  ///< [rays.size()] index y * width + x of each ray's pixel
};

/// Makes the rays of one workload. primary: one ray a pixel, row by row; random: one ray a pixel between two
/// points of the scene's box; shadow, ao, diffuse: from each primary hit, moved off the surface by an error
/// bound, towards the light (any hit), within the hemisphere up to a tenth of the scene's diagonal (any hit),
/// and with a cosine distribution (closest hit). A pixel whose primary ray misses starts no secondary ray.
/// Random numbers are counter-based: a ray depends on its pixel and the seed only. Bit-equal on every
/// machine, whatever the thread count: nothing but sums, products, quotients and square roots.
[[nodiscard]] Workload make_workload(WorkloadKind kind, const TriangleMesh& mesh, const MemoryImage& image,
                                     const Camera& camera, Resolution resolution, std::uint64_t seed);

}  // namespace rtu::model
