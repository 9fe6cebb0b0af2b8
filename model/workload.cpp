#include "model/workload.hpp"

#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "model/camera_frame.hpp"
#include "model/error.hpp"
#include "model/parallel.hpp"
#include "model/sampling.hpp"
#include "model/surface.hpp"
#include "model/traversal.hpp"
#include "model/vec3.hpp"

namespace rtu::model {
namespace {

constexpr std::array<std::pair<WorkloadKind, std::string_view>, 5> kind_names{
    {{WorkloadKind::Primary, "primary"},
     {WorkloadKind::Shadow, "shadow"},
     {WorkloadKind::AmbientOcclusion, "ao"},
     {WorkloadKind::Diffuse, "diffuse"},
     {WorkloadKind::Random, "random"}}};

// A point light to the upper right of the eye, half way to the first surface there and at most half of the
// scene's diagonal away: in a room it stays in the room, and everywhere it lights some of what the camera
// sees and not all.
Vec3 place_light(const MemoryImage& image, const Camera& camera) {
    const Ray view = camera_ray(camera, {1, 1}, 0, 0);
    const Vec3 right = direction_of(cross(view.direction, camera.up)).value_or(Vec3{1, 0, 0});
    const Vec3 direction = normalized(right + cross(right, view.direction));
    const float limit = distance_between(image.bounds.lo, image.bounds.hi);
    const std::optional<Hit> hit = trace(image, {camera.eye, 0, direction, limit}, RayKind::ClosestHit);
    return camera.eye + direction * (0.5F * (hit ? hit->t : limit));
}

std::optional<Ray> random_ray(const WorkloadSetting& setting, std::uint32_t pixel) {
    RandomStream random(setting.seed, std::uint32_t(WorkloadKind::Random), pixel);
    const Vec3 from = sample_box(random, setting.image.bounds);
    const std::optional<Vec3> direction = direction_between(from, sample_box(random, setting.image.bounds));
    if (!direction) return std::nullopt;
    return Ray{from, 0, *direction, infinity};
}

std::optional<Ray> secondary_ray(const WorkloadSetting& setting, WorkloadKind kind, std::uint32_t pixel,
                                 const SurfacePoint& point) {
    if (kind == WorkloadKind::Shadow) {
        const std::optional<Vec3> direction = direction_between(point.origin, setting.light);
        if (!direction) return std::nullopt;
        // Ends just short of the light, so that the light could sit on a surface.
        return Ray{point.origin, 0, *direction,
                   distance_between(point.origin, setting.light) * (1 - 0x1p-12F)};
    }
    RandomStream random(setting.seed, std::uint32_t(kind), pixel);
    Ray ray{point.origin, 0, sample_cosine(random, point.normal), infinity};
    if (kind == WorkloadKind::AmbientOcclusion) ray.t_max = setting.ao_distance;
    return ray;
}

std::optional<Ray> make_ray(const WorkloadSetting& setting, const CameraFrame& frame, WorkloadKind kind,
                            std::uint32_t pixel, TraversalStack& scratch) {
    if (kind == WorkloadKind::Random) return random_ray(setting, pixel);
    const Ray primary = frame.ray(pixel % setting.resolution.width, pixel / setting.resolution.width);
    if (kind == WorkloadKind::Primary) return primary;
    const std::optional<Hit> hit = trace(scratch, setting.image, primary, RayKind::ClosestHit);
    if (!hit) return std::nullopt;
    const std::optional<SurfacePoint> point = surface_point(setting.mesh, *hit, primary.direction);
    if (!point) return std::nullopt;
    return secondary_ray(setting, kind, pixel, *point);
}

// The rays of `pixel_count` pixels, of which `pixel_at` tells each.
template <class PixelAt>
Workload make_workload_of(WorkloadKind kind, const WorkloadSetting& setting, std::uint32_t pixel_count,
                          PixelAt pixel_at) {
    std::vector<std::optional<Ray>> rays(pixel_count);
    const CameraFrame frame(setting.camera, setting.resolution);
    for_each_range<std::uint32_t>(pixel_count, 256, [&](const auto& range) {
        TraversalStack scratch;
        for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
            rays[i] = make_ray(setting, frame, kind, pixel_at(i), scratch);
        }
    });
    Workload workload{std::string(to_string(kind)), ray_kind(kind), {}, {}};
    for (std::uint32_t i = 0; i < pixel_count; ++i) {
        if (!rays[i]) continue;
        workload.rays.push_back(*rays[i]);
        workload.pixels.push_back(pixel_at(i));
    }
    return workload;
}

}  // namespace

WorkloadKind parse_workload_kind(std::string_view text) {
    for (const auto& [kind, name] : kind_names) {
        if (text == name) return kind;
    }
    throw Error("workload: expected primary, shadow, ao, diffuse or random, got '{}'", text);
}

std::string_view to_string(WorkloadKind kind) { return kind_names[std::size_t(kind)].second; }

RayKind ray_kind(WorkloadKind kind) {
    const bool is_any_hit = kind == WorkloadKind::Shadow || kind == WorkloadKind::AmbientOcclusion;
    return is_any_hit ? RayKind::AnyHit : RayKind::ClosestHit;
}

WorkloadSetting::WorkloadSetting(const TriangleMesh& scene_mesh, const MemoryImage& scene_image,
                                 const Camera& view, Resolution picture, std::uint64_t random_seed)
    : mesh(scene_mesh),
      image(scene_image),
      camera(view),
      resolution(picture),
      seed(random_seed),
      light(place_light(image, camera)),
      ao_distance(0.1F * distance_between(image.bounds.lo, image.bounds.hi)) {}

Workload make_workload(WorkloadKind kind, const WorkloadSetting& setting, std::uint32_t begin_pixel,
                       std::uint32_t end_pixel) {
    return make_workload_of(kind, setting, end_pixel - begin_pixel,
                            [begin_pixel](std::uint32_t i) { return begin_pixel + i; });
}

Workload make_workload(WorkloadKind kind, const WorkloadSetting& setting,
                       std::span<const std::uint32_t> pixels) {
    return make_workload_of(kind, setting, std::uint32_t(pixels.size()),
                            [pixels](std::uint32_t i) { return pixels[i]; });
}

Workload make_workload(WorkloadKind kind, const TriangleMesh& mesh, const MemoryImage& image,
                       const Camera& camera, Resolution resolution, std::uint64_t seed) {
    return make_workload(kind, WorkloadSetting(mesh, image, camera, resolution, seed), 0,
                         resolution.width * resolution.height);
}

}  // namespace rtu::model
