#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/exact_sum.hpp"
#include "model/rounded_quotient.hpp"
#include "model/vec3.hpp"

namespace rtu::model {

/// On which side of an edge a ray passes. Neither only when the ends coincide as the ray sees them.
enum class Side : std::int8_t { Negative = -1, Neither = 0, Positive = 1 };

/// A ray's line as it was given, and the axis along which it is seen: of its largest direction component.
struct Line {
    Vec3 origin, direction;
    std::uint8_t axis = 0;
};

/// Where a line meets a triangle's plane: origin + t direction, and (1 - u - v) a + u b + v c.
struct PlanePoint {
    float t, u, v;
};

/// A triangle and a line, both as they were given; all numbers may be any finite binary32. Binary64 decides
/// where its error bound allows, exact expansions [SHE97] elsewhere. Edge i leads from corner i to the next.
class ExactTriangle {
  public:
    ExactTriangle(const Line& line, const std::array<Vec3, 3>& corners);

    /// The volume that the line's direction spans with edge p -> q seen from its origin, direction . ((p -
    /// origin) x (q - p)). Its sign, and whether it is zero, are exact; the error is at most 2^-48
    /// |direction|_1 |p - origin|_max |q - p|_max.
    [[nodiscard]] Bounded edge_function(std::size_t edge) const;

    /// The side of an edge on which the line passes, given its edge_function(): the sign of that. Where it is
    /// zero, the side of the line moved by (e, e^2), e infinitely small and positive, along the two axes that
    /// follow the line's. Exact. Reversing the edge reverses the answer, so of the two triangles at an edge
    /// exactly one owns the ray, and of a fan around a vertex as well.
    [[nodiscard]] Side side(std::size_t edge, Bounded edge_function) const;

    /// Where the line meets the plane of the corners a, b, c, if that is beyond `t_min`: t = (a - origin) . n
    /// / (direction . n), n = (b - a) x (c - a), and u and v as the edge functions of c -> a and a -> b by
    /// direction . n. Each is its exact value rounded once to binary32, nearest even; an exact zero is +0. t
    /// may be infinite. Requires all three edge functions, and a plane that the line is not parallel to.
    [[nodiscard]] std::optional<PlanePoint> point_beyond(float t_min,
                                                         const std::array<Bounded, 3>& edge_functions) const;

  private:
    using Vector = std::array<double, 3>;
    // Rounded to binary64, and its largest component.
    struct Difference {
        Difference(Vec3 to, Vec3 from);
        Vector vector;
        double size;
    };
    [[nodiscard]] ExactSum<36> expanded_edge_function(std::size_t edge) const;
    [[nodiscard]] ExactSum<36> expanded_along() const;
    [[nodiscard]] float exact_distance() const;
    [[nodiscard]] float exact_barycentric(std::size_t edge) const;

    Line line_;
    std::array<Vec3, 3> corners_;
    Vector direction_;
    double direction_length_;  // sum of its components' magnitudes
    std::array<Difference, 3> seen_;
    std::array<Difference, 3> edges_;
};

}  // namespace rtu::model
