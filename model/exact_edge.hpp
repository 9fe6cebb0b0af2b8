#pragma once

#include <array>
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

/// A point as it was given, its difference from a line's origin, rounded to binary64, and the largest
/// component of that.
struct SeenPoint {
    SeenPoint(const Line& line, Vec3 point);
    Vec3 given;
    std::array<double, 3> seen;
    double reach;
};

/// The volume that the line's direction spans with the edge p -> q seen from its origin,
/// direction . ((p - origin) x (q - origin)). Its sign, and whether it is zero, are exact whatever the finite
/// numbers: binary64 decides where its error bound allows, exact expansions [SHE97] elsewhere. The magnitude
/// is good to 2^-48 |direction|_1 p.reach q.reach.
[[nodiscard]] double exact_edge_function(const Line& line, const SeenPoint& p, const SeenPoint& q);

/// The side of an edge whose exact_edge_function() is zero: that of the line moved by (e, e^2), e infinitely
/// small and positive, along the two axes that follow `line.axis`. Exact. Reversing the edge reverses the
/// answer, so of the two triangles at an edge exactly one owns the ray, and of a fan around a vertex as well.
[[nodiscard]] Side exact_tie(const Line& line, Vec3 p, Vec3 q);

}  // namespace rtu::model
