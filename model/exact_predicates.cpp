#include "model/exact_predicates.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "model/exact_sum.hpp"

namespace rtu::model {

namespace {

/// A point of one coordinate plane. Double holds every difference of floats to half an ulp and every product
/// of two floats exactly, and neither overflows nor underflows: floats are multiples of 2^-149 and below
/// 2^128.
struct Point2 {
    double x, y;
};

/// Quick and certain: true only when the doubled area is farther from zero than its rounding error can be.
bool is_surely_triangle(Point2 a, Point2 b, Point2 c) {
    const double left = (b.x - a.x) * (c.y - a.y);
    const double right = (b.y - a.y) * (c.x - a.x);
    constexpr double unit_roundoff = 0x1p-53;
    constexpr double error_factor = (3 + 16 * unit_roundoff) * unit_roundoff;  // [SHE97], bound A of orient2d
    return std::fabs(left - right) > error_factor * (std::fabs(left) + std::fabs(right));
}

/// Whether the doubled area a x b + b x c + c x a is exactly zero; its six products are exact in double.
bool has_zero_area(Point2 a, Point2 b, Point2 c) {
    const std::array<double, 6> products{a.x * b.y,    -(a.y * b.x), b.x * c.y,
                                         -(b.y * c.x), c.x * a.y,    -(c.y * a.x)};
    return ExactSum(products).value() == 0;
}

Point2 project(Vec3 p, std::size_t axis) { return {double(p[(axis + 1) % 3]), double(p[(axis + 2) % 3])}; }

}  // namespace

bool is_collinear(Vec3 a, Vec3 b, Vec3 c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (is_surely_triangle(project(a, axis), project(b, axis), project(c, axis))) {
            return false;
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!has_zero_area(project(a, axis), project(b, axis), project(c, axis))) {
            return false;
        }
    }
    return true;
}

}  // namespace rtu::model
