#include "model/surface.hpp"

#include <algorithm>

#include "model/sampling.hpp"

namespace rtu::model {
namespace {

float largest_component(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

std::optional<Vec3> geometric_normal(const TriangleMesh& mesh, std::uint32_t primitive_id) {
    const Triangle& triangle = mesh.triangles[primitive_id];
    const Vec3 a = mesh.positions[triangle[0]];
    const Vec3 b = mesh.positions[triangle[1]], c = mesh.positions[triangle[2]];
    // In binary64: needles lose all digits of a binary32 cross product, and tiny or huge triangles leave its
    // range.
    const double ux = double(b.x) - a.x, uy = double(b.y) - a.y, uz = double(b.z) - a.z;
    const double vx = double(c.x) - a.x, vy = double(c.y) - a.y, vz = double(c.z) - a.z;
    return direction_of(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
}

std::optional<SurfacePoint> surface_point(const TriangleMesh& mesh, const Hit& hit, Vec3 ray_direction) {
    const std::optional<Vec3> normal = geometric_normal(mesh, hit.primitive_id);
    if (!normal) return std::nullopt;
    const Triangle& triangle = mesh.triangles[hit.primitive_id];
    const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]],
               c = mesh.positions[triangle[2]];
    const Vec3 point = a * (1 - hit.u - hit.v) + b * hit.u + c * hit.v;
    const Vec3 facing = dot(*normal, ray_direction) > 0 ? -*normal : *normal;
    const float scale = std::max({largest_component(a), largest_component(b), largest_component(c)});
    return SurfacePoint{point + facing * (scale * 0x1p-19F), facing};
}

}  // namespace rtu::model
