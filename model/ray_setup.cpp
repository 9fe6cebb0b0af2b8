#include "model/ray_setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rtu::model {

namespace {

constexpr float pad_scale = 0x1p-20F;       // 16 * 2^-24 of the scene's reach: see RaySetup
constexpr float rounding_scale = 0x1p-23F;  // covers the rounding of the moved origin itself

std::uint8_t largest_axis(Vec3 d) {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

// An axis along which the ray hardly moves has an infinite reciprocal; unless it does not move at all, the
// product of plane distance and reciprocal would then be wrong, so the axis is taken out of the slab test.
float reciprocal(float direction) {
    const float inverse = 1.0F / direction;
    return std::isinf(inverse) && direction != 0.0F ? std::numeric_limits<float>::quiet_NaN() : inverse;
}

// Largest distance, over the axes, from the origin to a plane of the scene's box.
float reach(Vec3 origin, const Aabb& bounds) {
    float result = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result = std::max(
            {result, std::abs(bounds.lo[axis] - origin[axis]), std::abs(bounds.hi[axis] - origin[axis])});
    }
    return result;
}

}  // namespace

std::optional<RaySetup> make_ray_setup(const Ray& ray, const Aabb& bounds) {
    const Vec3 d = ray.direction;
    // Written so that a NaN in the interval fails it.
    if (!is_finite(ray.origin) || !is_finite(d) || d == Vec3{} || !(ray.t_min < ray.t_max))
        return std::nullopt;

    RaySetup setup;
    setup.origin = ray.origin;
    setup.t_min = ray.t_min;
    setup.t_max = ray.t_max;
    setup.kz = largest_axis(d);
    setup.kx = std::uint8_t((setup.kz + 1) % 3);
    setup.ky = std::uint8_t((setup.kz + 2) % 3);
    setup.shear_x = d[setup.kx] / d[setup.kz];
    setup.shear_y = d[setup.ky] / d[setup.kz];
    setup.scale_z = 1.0F / d[setup.kz];

    const float scene_pad = reach(ray.origin, bounds) * pad_scale;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        setup.inv_direction[axis] = reciprocal(d[axis]);
        setup.is_negative[axis] = std::signbit(d[axis]);
        const float pad = scene_pad + std::abs(ray.origin[axis]) * rounding_scale;
        const float towards = setup.is_negative[axis] ? -pad : pad;
        setup.origin_near[axis] = ray.origin[axis] + towards;
        setup.origin_far[axis] = ray.origin[axis] - towards;
    }
    return setup;
}

}  // namespace rtu::model
