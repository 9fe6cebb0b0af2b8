#include "study/chart/pixel_data.hpp"

#include "model/parallel.hpp"
#include "model/surface.hpp"
#include "model/traversal.hpp"

namespace rtu::study {

PixelData trace_pixels(const model::TriangleMesh& mesh, const model::MemoryImage& image,
                       const model::Camera& camera, model::Resolution resolution) {
    const std::uint32_t count = resolution.width * resolution.height;
    PixelData data{resolution, std::vector<std::optional<model::Vec3>>(count),
                   std::vector<std::uint32_t>(count)};
    model::for_each_range<std::uint32_t>(count, 256, [&](const auto& range) {
        model::TraversalStack scratch;
        for (std::uint32_t pixel = range.begin(); pixel != range.end(); ++pixel) {
            const model::Ray ray =
                camera_ray(camera, resolution, pixel % resolution.width, pixel / resolution.width);
            model::TraversalCounts counts;
            const auto hit = trace(scratch, image, ray, model::RayKind::ClosestHit, &counts);
            data.box_tests[pixel] = std::uint32_t(counts.box_tests);
            if (!hit) continue;
            if (const auto point = surface_point(mesh, *hit, ray.direction))
                data.normals[pixel] = point->normal;
        }
    });
    return data;
}

}  // namespace rtu::study
