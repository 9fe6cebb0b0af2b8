#pragma once

// Ray against triangle in rational arithmetic, by the definitions of docs/model.md and nothing else.

#include <algorithm>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <optional>

#include "model/vec3.hpp"

namespace rtu::test {

using Rational = boost::multiprecision::mpq_rational;
using Point2 = std::array<Rational, 2>;

/// A ray's line, seen along its direction: points of space become points of a plane, the line the origin.
class ExactView {
  public:
    ExactView(model::Vec3 origin, model::Vec3 direction, std::size_t axis)
        : origin_(origin), direction_(direction), axis_(axis) {}

    /// Distance along the axis from the ray's origin.
    [[nodiscard]] Rational along(model::Vec3 p, std::size_t axis) const {
        return Rational(double(p[axis])) - Rational(double(origin_[axis]));
    }
    [[nodiscard]] Point2 see(model::Vec3 p) const {
        const auto sheared = [&](std::size_t other) {
            const Rational slope = Rational(double(direction_[other])) / Rational(double(direction_[axis_]));
            return Rational(along(p, other) - slope * along(p, axis_));
        };
        return {sheared((axis_ + 1) % 3), sheared((axis_ + 2) % 3)};
    }
    /// Sign of the edge function of p -> q at the origin moved by (e, e^2), e infinitely small: the
    /// coefficients of 1, e and e^2 in turn.
    [[nodiscard]] int side(model::Vec3 p, model::Vec3 q) const {
        const Point2 a = see(p), b = see(q);
        for (const Rational& coefficient :
             {Rational(a[0] * b[1] - a[1] * b[0]), Rational(a[1] - b[1]), Rational(b[0] - a[0])}) {
            if (coefficient != 0) return coefficient > 0 ? 1 : -1;
        }
        return 0;
    }

  private:
    model::Vec3 origin_, direction_;
    std::size_t axis_;
};

struct ExactHit {
    Rational t, u, v;  ///< u, v: weights of the second and third corner
};

inline std::optional<ExactHit> exact_hit(const ExactView& view, const std::array<model::Vec3, 3>& corners,
                                         std::size_t axis, float direction) {
    const auto& [a, b, c] = corners;
    const int side = view.side(a, b);
    if (side == 0 || side != view.side(b, c) || side != view.side(c, a)) return std::nullopt;
    const Point2 p = view.see(a), q = view.see(b), r = view.see(c);
    const auto cross = [](const Point2& x, const Point2& y) { return Rational(x[0] * y[1] - x[1] * y[0]); };
    const Rational wa = cross(q, r), wb = cross(r, p), wc = cross(p, q), area = wa + wb + wc;
    const Rational depth = wa * view.along(a, axis) + wb * view.along(b, axis) + wc * view.along(c, axis);
    return ExactHit{depth / (area * Rational(double(direction))), wb / area, wc / area};
}

/// The nearest binary32, of two equally near ones the one with an even significand; infinity from half a unit
/// beyond the largest on. Zero is +0.
inline float rounded_once(const Rational& exact) {
    using Integer = boost::multiprecision::mpz_int;
    const Rational size = abs(exact);
    if (size == 0) return 0;
    int exponent = int(msb(numerator(size))) - int(msb(denominator(size))) - 24;
    const auto scaled = [&size](int by) {
        const Rational power(Integer(1) << unsigned(std::abs(by)));
        return by > 0 ? Rational(size / power) : Rational(size * power);
    };
    while (scaled(exponent) >= 0x1p24) ++exponent;
    exponent = std::max(exponent, -149);
    const Rational units = scaled(exponent);
    Integer digits = numerator(units) / denominator(units);
    const Rational rest = units - digits, half(1, 2);
    if (rest > half || (rest == half && digits % 2 != 0)) ++digits;
    const auto rounded = float(std::ldexp(digits.convert_to<double>(), exponent));
    return exact < 0 ? -rounded : rounded;
}

}  // namespace rtu::test
