#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "model/ray.hpp"

// Ray-triangle intersection methods of the literature and our own, to be compared: what each is, where it
// comes from, and one call that tests a ray against a triangle. Sources by key: docs/methods.md.

namespace rtu::model::methods {

/// A triangle's corners a, b, c.
using Corners = std::array<Vec3, 3>;

/// What a test finds: the point origin + t * direction = (1 - u - v) * a + u * b + v * c.
struct TestHit {
    float t = 0, u = 0, v = 0;
    friend bool operator==(const TestHit&, const TestHit&) = default;
};

/// Whose largest component chooses the plane that a method projects to, if any.
enum class AxisOwner : std::uint8_t { None, Ray, Triangle };

/// What a method is.
struct MethodInfo {
    std::string_view name;       ///< as in results: "moller_trumbore"
    std::string_view title;      ///< for people: "Moller-Trumbore"
    std::string_view source;     ///< key and equations: "[MT97] eq. 6"
    std::uint32_t stored_bytes;  ///< kept of a triangle, its axis aside
    AxisOwner axis_owner = AxisOwner::None;
    bool is_one_sided = false;  ///< triangles seen from behind (clockwise) are not hit
    /// In its pair form the second triangle is tested as (a, d, c); else as (a, c, d).
    bool is_pair_reversed = false;
};

/// How the compiler may treat a * b + c: as two roundings, or fused into one where the processor can.
enum class Contraction : std::uint8_t { Off, Fast };

/// A method as one call, its ray set-up and precomputation included; for experiments in which its own time
/// does not count. t lies in the ray's open interval as far as the method's arithmetic can tell. Whatever the
/// numbers, NaN and infinity included, the call returns; what it returns then is the method's own affair.
struct Method {
    MethodInfo info;
    std::optional<TestHit> (*test)(const Ray& ray, const Corners& triangle);
};

/// All methods, in the order of their publication, ours last. Fast leaves out `exact`, which is the machine's
/// own code, and `havel_herout_sse4`, whose roundings are the instructions' own, and is empty on a processor
/// that cannot fuse.
[[nodiscard]] std::span<const Method> all_methods(Contraction contraction = Contraction::Off);

/// The method of that name; null when there is none.
[[nodiscard]] const Method* find_method(std::string_view name, Contraction contraction = Contraction::Off);

}  // namespace rtu::model::methods
