#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace rtu::model {

inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// Three binary32 components: a point or a direction.
struct Vec3 {
    float x = 0, y = 0, z = 0;

    [[nodiscard]] constexpr float operator[](std::size_t axis) const {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    constexpr float& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

[[nodiscard]] constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
[[nodiscard]] constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
[[nodiscard]] constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
[[nodiscard]] constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
[[nodiscard]] constexpr Vec3 operator*(float s, Vec3 a) { return a * s; }
[[nodiscard]] constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }

/// `a` scaled to length 1; a zero vector gives NaN components.
[[nodiscard]] inline Vec3 normalized(Vec3 a) { return a * (1.0F / length(a)); }

[[nodiscard]] inline bool is_finite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace rtu::model
