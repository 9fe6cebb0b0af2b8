#include "model/exact_edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "model/exact_sum.hpp"

namespace rtu::model {

namespace {

// Floats are multiples of 2^-149 below 2^128: in double, products of two are exact, and products of three
// neither overflow nor underflow, so that a product's rounding error is a double as well.

using Vector = std::array<double, 3>;

Vector widen(Vec3 v) { return {v.x, v.y, v.z}; }

// The summands of a . (b x c), each product of three split into a double and its rounding error.
class TripleProducts {
  public:
    void add(const Vector& a, const Vector& b, const Vector& c, double sign) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            add_product(b[j] * c[k], sign * a[i]);
            add_product(b[k] * c[j], -sign * a[i]);
        }
    }
    [[nodiscard]] double sum() const { return ExactSum(summands_).value(); }

  private:
    void add_product(double a, double b) {
        const double product = a * b;
        summands_[count_++] = product;
        summands_[count_++] = std::fma(a, b, -product);
    }
    std::array<double, 36> summands_{};
    std::size_t count_ = 0;
};

// direction . (p x q - origin x q - p x origin), which is the volume without its differences.
double expanded(const Line& line, Vec3 p, Vec3 q) {
    const Vector d = widen(line.direction), o = widen(line.origin);
    TripleProducts products;
    products.add(d, widen(p), widen(q), 1);
    products.add(d, o, widen(q), -1);
    products.add(d, widen(p), o, -1);
    return products.sum();
}

// The sign of direction[axis] * (p - q)[other] - direction[other] * (p - q)[axis]: which end is farther along
// `other` in the plane in which the line is a point, times the sign of direction[axis].
int farther_end(const Line& line, Vec3 p, Vec3 q, std::size_t other) {
    const double along = line.direction[line.axis], across = line.direction[other];
    const double value = ExactSum(std::array{along * double(p[other]), -(along * double(q[other])),
                                             -(across * double(p[line.axis])), across * double(q[line.axis])})
                             .value();
    return (value > 0) - (value < 0);
}

}  // namespace

SeenPoint::SeenPoint(const Line& line, Vec3 point)
    : given(point),
      seen{double(point.x) - double(line.origin.x), double(point.y) - double(line.origin.y),
           double(point.z) - double(line.origin.z)},
      reach(std::max({std::fabs(seen[0]), std::fabs(seen[1]), std::fabs(seen[2])})) {}

double exact_edge_function(const Line& line, const SeenPoint& p, const SeenPoint& q) {
    const Vector d = widen(line.direction);
    double volume = 0, length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        volume += d[i] * (p.seen[j] * q.seen[k] - p.seen[k] * q.seen[j]);
        length += std::fabs(d[i]);
    }
    // Seven roundings of 2^-53 at most on the way of a term, and the terms add up to twice the product below
    // at most; the rest is for the roundings of the bound itself.
    const double error = 0x1p-48 * length * (p.reach * q.reach);
    return std::fabs(volume) > error ? volume : expanded(line, p.given, q.given);
}

Side exact_tie(const Line& line, Vec3 p, Vec3 q) {
    const std::size_t x = (line.axis + 1U) % 3, y = (line.axis + 2U) % 3;
    const int by_y = farther_end(line, p, q, y);
    return Side(by_y != 0 ? by_y : farther_end(line, q, p, x));
}

}  // namespace rtu::model
