#include "model/exact_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "model/exact_sum.hpp"
#include "model/rounded_quotient.hpp"

namespace rtu::model {

namespace {

// Floats are multiples of 2^-149 below 2^128: in double, products of two are exact, and products of three
// neither overflow nor underflow, so that a product's rounding error is a double as well.

using Vector = std::array<double, 3>;

Vector widen(Vec3 v) { return {v.x, v.y, v.z}; }

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length_1(const Vector& v) { return std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]); }

// u . (v x w) of differences that were rounded once errs by less than this share of |u|_1 |v|_max |w|_max: at
// most eight roundings of 2^-53 on the way of a term, and the terms add up to twice that product at most.
constexpr double error = 0x1p-48;

// The exact sum of several u . (v x w), each product of three floats split into a double and its rounding
// error.
template <std::size_t Count>
class TripleProducts {
  public:
    TripleProducts& add(const Vector& u, const Vector& v, const Vector& w, double sign) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            add_product(v[j] * w[k], sign * u[i]);
            add_product(v[k] * w[j], -sign * u[i]);
        }
        return *this;
    }
    [[nodiscard]] const ExactSum<12 * Count>& sum() const { return sum_; }

  private:
    void add_product(double a, double b) {
        const double product = a * b;
        sum_.add(product);
        sum_.add(std::fma(a, b, -product));
    }
    ExactSum<12 * Count> sum_;
};

// d . ((p - o) x (q - o)) without its differences.
[[gnu::noinline, gnu::cold]] ExactSum<36> expanded_span(Vec3 direction, Vec3 from, Vec3 to_p, Vec3 to_q) {
    const Vector d = widen(direction), o = widen(from), p = widen(to_p), q = widen(to_q);
    return TripleProducts<3>().add(d, p, q, 1).add(d, o, q, -1).add(d, p, o, -1).sum();
}

// (a - o) . ((b - a) x (c - a)) without its differences.
[[gnu::noinline, gnu::cold]] ExactSum<48> expanded_height(Vec3 origin, const std::array<Vec3, 3>& corners) {
    const Vector o = widen(origin), a = widen(corners[0]), b = widen(corners[1]), c = widen(corners[2]);
    return TripleProducts<4>().add(a, b, c, 1).add(o, b, c, -1).add(o, c, a, -1).add(o, a, b, -1).sum();
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

ExactTriangle::Difference::Difference(Vec3 to, Vec3 from)
    : vector{double(to.x) - double(from.x), double(to.y) - double(from.y), double(to.z) - double(from.z)},
      size(std::max(std::max(std::fabs(vector[0]), std::fabs(vector[1])), std::fabs(vector[2]))) {}

ExactTriangle::ExactTriangle(const Line& line, const std::array<Vec3, 3>& corners)
    : line_(line),
      corners_(corners),
      direction_(widen(line.direction)),
      direction_length_(length_1(direction_)),
      seen_{Difference{corners[0], line.origin}, {corners[1], line.origin}, {corners[2], line.origin}},
      edges_{Difference{corners[1], corners[0]}, {corners[2], corners[1]}, {corners[0], corners[2]}} {}

Bounded ExactTriangle::edge_function(std::size_t edge) const {
    const Difference &p = seen_[edge], &to_q = edges_[edge];
    const double value = dot(direction_, cross(p.vector, to_q.vector));
    const double bound = error * direction_length_ * (p.size * to_q.size);
    if (std::fabs(value) > bound) return {value, bound};
    return {expanded_edge_function(edge).value()};
}

Side ExactTriangle::side(std::size_t edge, Bounded edge_function) const {
    const double value = edge_function.value;
    if (value != 0) return value > 0 ? Side::Positive : Side::Negative;
    const Vec3 p = corners_[edge], q = corners_[(edge + 1) % 3];
    const std::size_t x = (line_.axis + 1U) % 3, y = (line_.axis + 2U) % 3;
    const int by_y = farther_end(line_, p, q, y);
    return Side(by_y != 0 ? by_y : farther_end(line_, q, p, x));
}

std::optional<PlanePoint> ExactTriangle::point_beyond(float t_min,
                                                      const std::array<Bounded, 3>& edge_functions) const {
    const Vector normal = cross(edges_[2].vector, edges_[0].vector);
    const double size = error * (edges_[2].size * edges_[0].size);
    Bounded along{dot(direction_, normal), size * direction_length_};
    if (!(along.error < 0x1p-30 * std::fabs(along.value))) along = {expanded_along().value()};
    const double inverse = 1 / along.value;
    const Bounded before{dot(seen_[0].vector, normal), size * length_1(seen_[0].vector)};
    const QuotientEnds t = quotient_ends(before, along, inverse);
    if (!(t.high > t_min)) return std::nullopt;  // the surface that a secondary ray leaves, mostly
    const auto barycentric = [&](std::size_t edge) {
        const QuotientEnds ends = quotient_ends(edge_functions[edge], along, inverse);
        return ends.are_equal() ? ends.low : exact_barycentric(edge);
    };
    const PlanePoint point{t.are_equal() ? t.low : exact_distance(), barycentric(2), barycentric(0)};
    return point.t > t_min ? std::optional(point) : std::nullopt;
}

ExactSum<36> ExactTriangle::expanded_edge_function(std::size_t edge) const {
    return expanded_span(line_.direction, line_.origin, corners_[edge], corners_[(edge + 1) % 3]);
}

ExactSum<36> ExactTriangle::expanded_along() const {
    return expanded_span(line_.direction, corners_[0], corners_[1], corners_[2]);
}

[[gnu::noinline, gnu::cold]] float ExactTriangle::exact_distance() const {
    return rounded_quotient(expanded_height(line_.origin, corners_), expanded_along());
}

[[gnu::noinline, gnu::cold]] float ExactTriangle::exact_barycentric(std::size_t edge) const {
    return rounded_quotient(expanded_edge_function(edge), expanded_along());
}

}  // namespace rtu::model
