#pragma once

#include <array>
#include <cstdint>

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
/// Slab test: seen along a plane's axis, its arithmetic errs by 3 * 2^-24 * D and the rounding of a hit's t
/// by 2^-24 * D, D the largest distance on that axis from the origin to the scene's box. Moving the planes
/// apart by 4 * 2^-24 * D each, by the rounding of the moved origin, and by a little for products of errors
/// and for underflow, therefore keeps the box of every triangle that the pair test accepts, and never lets a
/// ray enter it behind the hit's t. The planes move by moving the origin, so it costs nothing a box.
struct RaySetup {
    Vec3 origin, direction;  ///< as given
    Vec3 origin_near;        ///< origin for the plane at which the ray enters, per axis
    Vec3 origin_far;         ///< origin for the plane at which it leaves
    Vec3 inv_direction;      ///< NaN on an axis whose reciprocal is not a normal number: it culls nothing
    float t_min = 0;
    float t_max = 0;
    float shear_x = 0;
    float shear_y = 0;
    std::uint8_t kx = 0, ky = 0, kz = 0;
    std::array<std::uint32_t, 3> entry_side{};  ///< the plane at which the ray enters a box: 0 lo, 1 hi
};

/// False for a ray that hits nothing whatever the scene: a NaN or infinite origin or direction, a zero
/// direction, or not t_min < t_max.
[[nodiscard]] bool can_hit(const Ray& ray);

/// Requires can_hit(ray). `bounds` is the scene's box.
[[nodiscard]] RaySetup make_ray_setup(const Ray& ray, const Aabb& bounds);

}  // namespace rtu::model
