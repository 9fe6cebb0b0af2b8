#pragma once

#include <array>
#include <cstdint>

#include "model/methods/method.hpp"
#include "model/methods/number_format.hpp"

namespace rtu::model::methods {

/// Least and greatest value that a quantity can have.
struct Bounds {
    double lo = 0, hi = 0;
};

/// Operations of one test of a QuantisedFilter: at binary32, and in its narrow format. A product of two
/// intervals takes four multipliers, a sum two adders.
struct FilterOperations {
    std::uint32_t wide_add = 0, narrow_mul = 0, narrow_add = 0;
};

/// A test in narrow interval arithmetic that throws out triangles which the ray surely misses and passes all
/// others on to an exact one: cheap multipliers, no false negatives. Vertices are seen from the ray's origin
/// in binary32's precision or better; from then on every number is an interval whose ends are rounded
/// outwards to the format. Woop's shear and edge functions [WBW13] then enclose their exact values, and a
/// triangle is out
///  - when an edge function is surely positive and another surely negative,
///  - when all its corners are surely on one side of the ray, seen along either axis across it,
///  - when all its corners are surely before t_min, or beyond t_max.
class QuantisedFilter {
  public:
    /// Requires can_hit(ray), 2 to 8 bits of exponent and at most 23 of mantissa.
    QuantisedFilter(const Ray& ray, NumberFormat format);

    /// False only for a triangle that test_exactly() does not hit. Whatever overflows, or is NaN, passes.
    [[nodiscard]] bool may_hit(const Corners& triangle) const;

    [[nodiscard]] static FilterOperations operations();

  private:
    struct Corner {
        Bounds x, y, z;
    };
    [[nodiscard]] Corner seen(Vec3 vertex) const;

    NumberFormat format_;
    Vec3 origin_;
    std::array<int, 3> axes_{};  ///< x, y, z of a Corner: z is that of the largest component
    Bounds shear_x_, shear_y_;
    Bounds z_range_;  ///< z of points within the ray's interval
};

}  // namespace rtu::model::methods
