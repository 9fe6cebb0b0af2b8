#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/vec3.hpp"

namespace rtu::model {

/// On which side of an edge a ray passes. Neither only when the ends coincide as the ray sees them.
enum class Side : std::int8_t { Negative = -1, Neither = 0, Positive = 1 };

/// A ray's line as it was given, and the axis along which it is seen: of its largest direction component.
struct Line {
    Vec3 origin, direction;
    std::uint8_t axis = 0;
};

/// A triangle and a line, both as they were given; all numbers may be any finite binary32. Binary64 decides
/// where its error bound allows, exact expansions [SHE97] elsewhere. Edge i leads from corner i to the next.
class ExactTriangle {
  public:
    ExactTriangle(const Line& line, const std::array<Vec3, 3>& corners);

    /// The volume that the line's direction spans with edge p -> q seen from its origin, direction . ((p -
    /// origin) x (q - p)). Its sign, and whether it is zero, are exact; the magnitude is good to 2^-48
    /// |direction|_1 |p - origin|_max |q - p|_max.
    [[nodiscard]] double edge_function(std::size_t edge) const;

    /// The side of an edge on which the line passes, given its edge_function(): the sign of that. Where it is
    /// zero, the side of the line moved by (e, e^2), e infinitely small and positive, along the two axes that
    /// follow the line's. Exact. Reversing the edge reverses the answer, so of the two triangles at an edge
    /// exactly one owns the ray, and of a fan around a vertex as well.
    [[nodiscard]] Side side(std::size_t edge, double edge_function) const;

    /// Where the line meets the plane of corners a, b, c, in units of the direction: (a - origin) . n /
    /// (direction . n), n = (b - a) x (c - a). Good to 2^-28 of itself, with the exact sign. Requires a plane
    /// that the line is not parallel to.
    [[nodiscard]] double distance() const;

  private:
    using Vector = std::array<double, 3>;
    // Rounded to binary64, and its largest component.
    struct Difference {
        Difference(Vec3 to, Vec3 from);
        Vector vector;
        double size;
    };
    [[nodiscard]] double expanded_before() const;

    Line line_;
    std::array<Vec3, 3> corners_;
    Vector direction_;
    double direction_length_;  // sum of its components' magnitudes
    std::array<Difference, 3> seen_;
    std::array<Difference, 3> edges_;
};

}  // namespace rtu::model
