#pragma once

#include <optional>

#include "model/aabb.hpp"
#include "model/random.hpp"
#include "model/vec3.hpp"

namespace rtu::model {

/// (x, y, z) scaled to length 1; nothing for a zero vector or one with a NaN or infinite component. In
/// binary64, where the squares of no binary32 components overflow or vanish.
[[nodiscard]] inline std::optional<Vec3> direction_of(double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return Vec3{float(x / length), float(y / length), float(z / length)};
}
[[nodiscard]] inline std::optional<Vec3> direction_of(Vec3 v) { return direction_of(v.x, v.y, v.z); }

/// The direction from one point to another; nothing when they coincide.
[[nodiscard]] inline std::optional<Vec3> direction_between(Vec3 from, Vec3 to) {
    return direction_of(double(to.x) - from.x, double(to.y) - from.y, double(to.z) - from.z);
}

/// Distance between two points; at most the largest float.
[[nodiscard]] inline float distance_between(Vec3 a, Vec3 b) {
    const double x = double(b.x) - a.x, y = double(b.y) - a.y, z = double(b.z) - a.z;
    return float(std::min(std::sqrt(x * x + y * y + z * z), double(std::numeric_limits<float>::max())));
}

/// The point that lies `s` of the way from the box's low to its high corner, per axis; s in [0, 1].
[[nodiscard]] inline Vec3 point_in_box(const Aabb& box, Vec3 s) {
    const auto mix = [](float lo, float hi, float part) { return lo * (1 - part) + hi * part; };
    return {mix(box.lo.x, box.hi.x, s.x), mix(box.lo.y, box.hi.y, s.y), mix(box.lo.z, box.hi.z, s.z)};
}

/// Uniform in the box.
[[nodiscard]] inline Vec3 sample_box(RandomStream& random, const Aabb& box) {
    const float x = random.next(), y = random.next(), z = random.next();
    return point_in_box(box, {x, y, z});
}

/// Uniform on the unit sphere, by rejection and sqrt only [Mar72].
[[nodiscard]] inline Vec3 sample_sphere(RandomStream& random) {
    while (true) {
        const float a = 2 * random.next() - 1;
        const float b = 2 * random.next() - 1;
        const float s = a * a + b * b;
        if (s >= 1) continue;
        const float scale = 2 * std::sqrt(1 - s);
        return {a * scale, b * scale, 1 - 2 * s};
    }
}

/// Cosine-distributed about the unit vector `normal`, length 1: the direction to a uniform point on the unit
/// sphere that touches the surface. Draws again below 0.45 degrees from the surface (one draw in 16384),
/// where the rounding of the sum could turn the direction to the wrong side.
[[nodiscard]] inline Vec3 sample_cosine(RandomStream& random, Vec3 normal) {
    while (true) {
        const Vec3 sum = normal + sample_sphere(random);
        if (dot(sum, sum) >= 0x1p-12F) return normalized(sum);
    }
}

}  // namespace rtu::model
