#pragma once

#include <optional>

#include "model/mesh.hpp"
#include "model/ray.hpp"

namespace rtu::model {

/// Unit normal of a triangle, on the side from which its corners run counter-clockwise; nothing when the
/// triangle has no area.
[[nodiscard]] std::optional<Vec3> geometric_normal(const TriangleMesh& mesh, std::uint32_t primitive_id);

/// Where a ray met the surface.
struct SurfacePoint {
    Vec3 origin;  ///< where a secondary ray starts: off the surface, on the side that the ray came from
    Vec3 normal;  ///< unit length, on the same side
};

/// The start of the secondary rays of a hit. The hit point is interpolated from the corners, whose rounding
/// does not grow with the distance that the ray came, and moved along the geometric normal by 2^-19 of the
/// largest coordinate: 32 units of the rounding that interpolation (7, [PBR] 6.8) and the rounding of u and v
/// can make together. Nothing for a triangle without area.
[[nodiscard]] std::optional<SurfacePoint> surface_point(const TriangleMesh& mesh, const Hit& hit,
                                                        Vec3 ray_direction);

}  // namespace rtu::model
