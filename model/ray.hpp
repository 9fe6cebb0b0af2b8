#pragma once

#include <cstdint>

#include "model/vec3.hpp"

namespace rtu::model {

/// A ray: points origin + t * direction for t in the open interval (t_min, t_max).
/// `direction` need not have length 1; t is in units of its length.
struct Ray {
    Vec3 origin;
    float t_min = 0;
    Vec3 direction;
    float t_max = 0;
    friend bool operator==(const Ray&, const Ray&) = default;
};

/// What a ray asks for: its nearest hit, or whether anything at all is in its interval.
enum class RayKind : std::uint8_t { ClosestHit, AnyHit };

/// A hit: distance along the ray, barycentric weights of the triangle's second and third corner
/// (in the file's corner order), and the triangle's index in the scene.
struct Hit {
    float t = 0;
    float u = 0;
    float v = 0;
    std::uint32_t primitive_id = 0;
    friend bool operator==(const Hit&, const Hit&) = default;
};

}  // namespace rtu::model
