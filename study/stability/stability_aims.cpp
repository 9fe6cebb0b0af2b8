#include "study/stability/stability_aims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/mesh_builder.hpp"
#include "model/sampling.hpp"
#include "model/vec3.hpp"
#include "study/stability/stability_probes.hpp"

namespace rtu::study {
namespace {

using model::RandomStream;
using model::Ray;
using model::Vec3;
using model::methods::Corners;

using model::infinity;

const Corners& any_triangle(RandomStream& random, const Surface& surface) {
    return surface.corners[draw_below(random, std::uint32_t(surface.corners.size()))];
}

Vec3 target_of(RandomStream& random, const Surface& surface, Aim aim) {
    if (aim == Aim::Pole) return surface.mesh.positions[draw_below(random, 2)];
    const Corners& triangle = any_triangle(random, surface);
    if (aim == Aim::Vertex || aim == Aim::OutsideVertex) return draw_target(random, triangle, Target::Vertex);
    if (aim != Aim::EdgeMiddle) return draw_target(random, triangle, Target::Edge);
    const std::uint32_t edge = draw_below(random, 3);
    return (triangle[edge] + triangle[(edge + 1) % 3]) * 0.5F;
}

// Multiples of 2^-12 of the mesh: far from that fine, the difference to a vertex is often exact, and the ray
// meets it exactly.
Vec3 origin_inside(RandomStream& random, float radius) {
    Vec3 p = draw_point(random, radius * 0.57F);  // the cube within the sphere
    const float step = radius < 0x1p-8F ? 0x1p-24F : 0x1p-12F;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] / step) * step;
    return p;
}

Ray axis_ray(RandomStream& random, std::uint32_t squares, Aim aim) {
    const std::uint32_t axis = draw_below(random, 3);
    const auto line = [&] { return float(1 + draw_below(random, squares - 1)); };
    float i = line(), j = line();
    const float part = float(draw_below(random, 256)) / 256;
    if (aim == Aim::AxisEdge) (random.next() < 0.5F ? i : j) += part;
    if (aim == Aim::AxisDiagonal) {
        i += part;
        j += part;
    }
    const auto zero = [&] { return random.next() < 0.5F ? 0.0F : -0.0F; };
    Ray ray{{}, 0, {zero(), zero(), zero()}, infinity};
    ray.direction[axis] = random.next() < 0.5F ? 1.0F : -1.0F;
    ray.origin[(axis + 1) % 3] = 2 * i / float(squares) - 1;
    ray.origin[(axis + 2) % 3] = 2 * j / float(squares) - 1;
    return ray;
}

Ray along_triangle(RandomStream& random, const Surface& surface, Aim aim) {
    const Corners& triangle = any_triangle(random, surface);
    const std::uint32_t corner = draw_below(random, 3);
    const Vec3 a = triangle[corner], ab = triangle[(corner + 1) % 3] - a, ac = triangle[(corner + 2) % 3] - a;
    if (aim == Aim::EdgeParallel) return {a - ab * float(1 + draw_below(random, 16)), 0, ab, infinity};
    const float s = random.next(), x = draw_between(random, -1, 1), y = draw_between(random, -1, 1);
    const Vec3 direction = ab * x + ac * y, target = a + ab * s;
    return {target - direction * 16.0F, 0, direction, infinity};
}

bool is_from_outside(Aim aim) { return aim == Aim::OutsideVertex || aim == Aim::OutsideEdge; }

Ray draw_ray(RandomStream& random, const Surface& surface, float inner_radius, const Placement& placement,
             Aim aim) {
    if (aim == Aim::EdgeParallel || aim == Aim::InPlane) return along_triangle(random, surface, aim);
    const Vec3 place =
        is_from_outside(aim) ? model::sample_sphere(random) * 3.0F : origin_inside(random, inner_radius);
    const Vec3 origin = place * placement.scale + placement.offset;
    if (aim == Aim::Random) return {origin, 0, model::sample_sphere(random), infinity};
    return {origin, 0, target_of(random, surface, aim) - origin, infinity};
}

}  // namespace

std::string_view to_string(Aim aim) {
    constexpr std::array<std::string_view, 12> names{
        "random",    "edge",          "edge_middle",    "vertex",       "pole",          "axis_vertex",
        "axis_edge", "axis_diagonal", "outside_vertex", "outside_edge", "edge_parallel", "in_plane"};
    return names[std::size_t(aim)];
}

DrawRay rays_at(const std::shared_ptr<const Surface>& surface, float inner_radius, Placement placement,
                Aim aim, std::uint32_t squares) {
    return [=](RandomStream& random) {
        if (aim == Aim::AxisVertex || aim == Aim::AxisEdge || aim == Aim::AxisDiagonal) {
            return axis_ray(random, squares, aim);
        }
        while (true) {
            const Ray ray = draw_ray(random, *surface, inner_radius, placement, aim);
            if (ray.direction != Vec3{}) return ray;  // far away, target and origin may be one
        }
    };
}

std::vector<PlacedRays> everywhere(const ClosedMesh& mesh) {
    std::vector<PlacedRays> places;
    const model::TriangleMesh at_origin = mesh.make();
    for (const float scale : {1e-6F, 1.0F, 1e6F}) {
        for (const Vec3 offset :
             {Vec3{}, Vec3{1e3F, -1e3F, 5e2F}, Vec3{1e4F, -1e4F, 5e3F}, Vec3{1e5F, -1e5F, 5e4F},
              Vec3{148376, 1234, -223423}, Vec3{1e6F, -1e6F, 5e5F}, Vec3{1e7F, -1e7F, 5e6F}}) {
            const float largest = std::max(std::abs(offset.x), std::abs(offset.z));
            const Placement placement{std::max(scale, largest * 0x1p-12F), offset};
            if (scale < 1 && placement.scale > scale) continue;  // the same as at scale 1, or nearly
            const auto surface = placed_surface(at_origin, placement);
            for (const Aim aim : {Aim::Vertex, Aim::Edge, Aim::Random}) {
                places.push_back({surface, rays_at(surface, mesh.inner_radius, placement, aim)});
            }
        }
    }
    return places;
}

std::shared_ptr<const Surface> placed_surface(const model::TriangleMesh& mesh, Placement placement) {
    return std::make_shared<const Surface>(model::placed(mesh, placement.scale, placement.offset));
}

}  // namespace rtu::study
