#include "model/ray_setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rtu::model {

namespace {

// A little above 4 and 1 times the unit roundoff 2^-24, and the least normal number: see RaySetup.
constexpr float reach_pad = 0x1.08p-22F;
constexpr float origin_pad = 0x1.02p-24F;
constexpr float least_pad = 0x1p-126F;

std::uint8_t largest_axis(Vec3 d) {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

// An axis whose reciprocal overflows, or is too small to have all its digits, is taken out of the slab test;
// one along which the ray does not move at all stays, with an infinite reciprocal.
float reciprocal(float direction) {
    const float inverse = 1.0F / direction;
    return std::isnormal(inverse) || direction == 0.0F ? inverse : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

bool can_hit(const Ray& ray) {
    // A NaN in the interval fails the comparison.
    return is_finite(ray.origin) && is_finite(ray.direction) && ray.direction != Vec3{} &&
           ray.t_min < ray.t_max;
}

RaySetup make_ray_setup(const Ray& ray, const Aabb& bounds) {
    const Vec3 d = ray.direction;
    RaySetup setup;
    setup.origin = ray.origin;
    setup.direction = d;
    setup.t_min = ray.t_min;
    setup.t_max = ray.t_max;
    setup.kz = largest_axis(d);
    setup.kx = std::uint8_t((setup.kz + 1) % 3);
    setup.ky = std::uint8_t((setup.kz + 2) % 3);
    setup.shear_x = d[setup.kx] / d[setup.kz];
    setup.shear_y = d[setup.ky] / d[setup.kz];

    for (std::size_t axis = 0; axis < 3; ++axis) {
        setup.inv_direction[axis] = reciprocal(d[axis]);
        setup.entry_side[axis] = std::signbit(d[axis]) ? 1 : 0;
        const float o = ray.origin[axis];
        const float reach = std::max(std::abs(bounds.lo[axis] - o), std::abs(bounds.hi[axis] - o));
        const float pad = reach * reach_pad + std::abs(o) * origin_pad + least_pad;
        const float towards = std::signbit(d[axis]) ? -pad : pad;
        setup.origin_near[axis] = ray.origin[axis] + towards;
        setup.origin_far[axis] = ray.origin[axis] - towards;
    }
    return setup;
}

}  // namespace rtu::model
