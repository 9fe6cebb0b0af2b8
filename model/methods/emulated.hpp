#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "model/methods/method.hpp"
#include "model/methods/number_format.hpp"

namespace rtu::model::methods {

/// A number of a format that is chosen at run time, for the methods' templates: held in binary64, and rounded
/// to the format after each operation. Rounding twice is innocent, as binary64 has more than twice a
/// significand of 24 bits and two more [Fig95], and more than the range of a 10-bit exponent: (8, 23) is
/// binary32 to the bit. A number made from a float is a constant of any format, and is not rounded: only 0
/// and powers of two may be made so.
struct Emulated {
    double value = 0;
    NumberFormat format{0, 0};  ///< no bits: a constant

    Emulated() = default;
    explicit Emulated(float constant) : value(double(constant)) {}
    /// `number` rounded to the format.
    Emulated(NumberFormat of, double number) : value(rounded(of, number)), format(of) {}

    [[nodiscard]] friend Emulated operator+(Emulated a, Emulated b) { return made(a, b, a.value + b.value); }
    [[nodiscard]] friend Emulated operator-(Emulated a, Emulated b) { return made(a, b, a.value - b.value); }
    [[nodiscard]] friend Emulated operator*(Emulated a, Emulated b) { return made(a, b, a.value * b.value); }
    [[nodiscard]] friend Emulated operator/(Emulated a, Emulated b) { return made(a, b, a.value / b.value); }
    [[nodiscard]] friend Emulated operator-(Emulated a) { return exactly(a.format, -a.value); }
    [[nodiscard]] friend bool operator<(Emulated a, Emulated b) { return a.value < b.value; }
    [[nodiscard]] friend bool operator>(Emulated a, Emulated b) { return a.value > b.value; }
    [[nodiscard]] friend bool operator<=(Emulated a, Emulated b) { return a.value <= b.value; }
    [[nodiscard]] friend bool operator>=(Emulated a, Emulated b) { return a.value >= b.value; }
    [[nodiscard]] friend bool operator==(Emulated a, Emulated b) { return a.value == b.value; }
    explicit operator double() const { return value; }

    [[nodiscard]] friend Emulated select(bool mask, Emulated yes, Emulated no) { return mask ? yes : no; }
    [[nodiscard]] friend Emulated magnitude(Emulated a) { return exactly(a.format, std::abs(a.value)); }
    [[nodiscard]] friend Emulated flip_sign(Emulated a, Emulated by) {
        return std::signbit(by.value) ? -a : a;
    }
    [[nodiscard]] friend bool has_same_sign(Emulated a, Emulated b) {
        return std::signbit(a.value) == std::signbit(b.value);
    }
    [[nodiscard]] friend bool has_same_sign(Emulated a, Emulated b, Emulated c) {
        return has_same_sign(a, b) && has_same_sign(b, c);
    }
    [[nodiscard]] friend Emulated smaller(Emulated a, Emulated b) { return a < b ? a : b; }
    [[nodiscard]] friend Emulated larger(Emulated a, Emulated b) { return a > b ? a : b; }
    /// As for other scalars (numeric-inl.hpp): products of two are exact in binary64, what is returned is
    /// rounded to the format.
    [[nodiscard]] friend Emulated edge_function_in_double(Emulated x1, Emulated y1, Emulated x2,
                                                          Emulated y2) {
        return made(x1, y1, x1.value * y2.value - y1.value * x2.value);
    }
    [[nodiscard]] friend Emulated owned_edge_function(Emulated x1, Emulated y1, Emulated x2, Emulated y2) {
        const double exact = x1.value * y2.value - y1.value * x2.value;
        if (exact < 0 || exact > 0) return made(x1, y1, exact);
        return exactly(x1.format, y1 < y2 || (y1 == y2 && x1 > x2) ? -0.0 : 0.0);
    }

  private:
    [[nodiscard]] static Emulated exactly(NumberFormat of, double number) {
        Emulated result;
        result.value = number;
        result.format = of;
        return result;
    }
    [[nodiscard]] static Emulated made(Emulated a, Emulated b, double number) {
        const NumberFormat of = a.format.exponent_bits != 0 ? a.format : b.format;
        return of.exponent_bits != 0 ? Emulated(of, number) : exactly(of, number);
    }
};

/// A hit in numbers of the format, which need not be in binary32's range.
struct EmulatedHit {
    double t = 0, u = 0, v = 0;
};

/// A method as one call in arithmetic of any format. Ray, interval and triangle, given in binary32, are
/// rounded to the format first: its hardware stores and receives nothing wider.
struct EmulatedMethod {
    MethodInfo info;
    std::optional<EmulatedHit> (*test)(const Ray& ray, const Corners& triangle, NumberFormat format);
};

/// Those of all_methods() that are made of rounded arithmetic, in its order: all but `exact`, and
/// `woop_exact`, whose error bounds are those of binary32, and `havel_herout_sse4`, which is no template.
[[nodiscard]] std::span<const EmulatedMethod> emulated_methods();

/// The ray and the triangle as a format of at most 23 bits of mantissa holds them, as binary32 again. What a
/// narrower exponent cannot hold becomes infinity or zero.
[[nodiscard]] Ray rounded(NumberFormat format, const Ray& ray);
[[nodiscard]] Corners rounded(NumberFormat format, const Corners& triangle);

}  // namespace rtu::model::methods
