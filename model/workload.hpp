#pragma once

#include <cstdint>
#include <span>
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
/// Any hit for shadow and ao, closest hit for the others.
[[nodiscard]] RayKind ray_kind(WorkloadKind kind);

/// Rays of one kind, in the order in which they are handed to the machine.
struct Workload {
    std::string name;
    RayKind ray_kind = RayKind::ClosestHit;
    std::vector<Ray> rays;
    std::vector<std::uint32_t> pixels;  ///< [rays.size()] index y * width + x of each ray's pixel
};

/// What the rays of all workloads of one picture are made from.
struct WorkloadSetting {
    /// The mesh, the image and the camera must outlive it. Places the light: one ray is traced.
    WorkloadSetting(const TriangleMesh& scene_mesh, const MemoryImage& scene_image, const Camera& view,
                    Resolution picture, std::uint64_t random_seed);
    const TriangleMesh& mesh;
    const MemoryImage& image;
    const Camera& camera;
    Resolution resolution;
    std::uint64_t seed;
    Vec3 light;
    float ao_distance;  ///< length of an ambient-occlusion ray
};

/// Makes the rays of one workload. primary: one ray a pixel, row by row; random: one ray a pixel between two
/// points of the scene's box; shadow, ao, diffuse: from each primary hit, moved off the surface by an error
/// bound, towards the light (any hit), within the hemisphere up to a tenth of the scene's diagonal (any hit),
/// and with a cosine distribution (closest hit). A pixel whose primary ray misses starts no secondary ray.
/// Random numbers are counter-based: a ray depends on its pixel and the seed only. Bit-equal on every
/// machine, whatever the thread count: nothing but sums, products, quotients and square roots.
[[nodiscard]] Workload make_workload(WorkloadKind kind, const TriangleMesh& mesh, const MemoryImage& image,
                                     const Camera& camera, Resolution resolution, std::uint64_t seed);

/// The part of it that starts in the pixels [begin_pixel, end_pixel): the parts of a picture, one after
/// another, are the whole workload, so that it need not fit into memory.
[[nodiscard]] Workload make_workload(WorkloadKind kind, const WorkloadSetting& setting,
                                     std::uint32_t begin_pixel, std::uint32_t end_pixel);

/// The rays that start in some pixels, in their order.
[[nodiscard]] Workload make_workload(WorkloadKind kind, const WorkloadSetting& setting,
                                     std::span<const std::uint32_t> pixels);

}  // namespace rtu::model
