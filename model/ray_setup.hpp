#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "model/aabb.hpp"
#include "model/ray.hpp"

namespace rtu::model {

/// What the machine computes once per ray.
///
/// Shear (Woop, Benthin, Wald 2013): kz is the axis of the largest direction component, and a vertex v
/// becomes
///   A = v - origin;  x = A[kx] - shear_x * A[kz];  y = A[ky] - shear_y * A[kz];  z = A[kz]
/// so that the ray runs along z. |shear_x|, |shear_y| <= 1.
///
/// Slab test: the rounding of the sheared coordinates moves a vertex by less than 6 * 2^-24 * D across the
/// ray and the slab arithmetic errs by less than 3 * 2^-24 * D along it, D the largest distance, per axis,
/// from the origin to the scene's box. Moving the planes apart by 2^-20 * D (and by the rounding of the moved
/// origin) therefore keeps the box of every triangle that the pair test accepts. The planes move by moving
/// the origin, so it costs nothing a box.
struct RaySetup {
    Vec3 origin;
    Vec3 origin_near;    ///< origin for the plane at which the ray enters, per axis
    Vec3 origin_far;     ///< origin for the plane at which it leaves
    Vec3 inv_direction;  ///< NaN on an axis whose reciprocal overflows: that axis then culls nothing
    float t_min = 0;
    float t_max = 0;
    float shear_x = 0;
    float shear_y = 0;
    float scale_z = 0;  ///< 1 / direction[kz]
    std::uint8_t kx = 0, ky = 0, kz = 0;
    std::array<bool, 3> is_negative{};  ///< sign of inv_direction: the ray enters at hi
};

/// Nothing for a ray that cannot hit: a NaN or infinite origin or direction, a zero direction, or not t_min <
/// t_max. `bounds` is the scene's box.
[[nodiscard]] std::optional<RaySetup> make_ray_setup(const Ray& ray, const Aabb& bounds);

}  // namespace rtu::model
