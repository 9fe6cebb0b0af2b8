// What a method's arithmetic is made of. A method is a template over Real: binary32, one of Highway's vectors
// (Lanes), a type that counts operations, or one that rounds to a narrower format. A comparison gives a Mask:
// bool, or one bit a lane.

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "model/exact_predicates.hpp"
#include "model/methods/target.hpp"
#include "model/vec3.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

template <class Real>
using MaskOf = decltype(Real(0.0F) < Real(0.0F));

[[nodiscard]] HWY_INLINE bool is_none(bool mask) { return !mask; }
[[nodiscard]] HWY_INLINE bool is_all(bool mask) { return mask; }
[[nodiscard]] HWY_INLINE bool inverted(bool mask) { return !mask; }
[[nodiscard]] HWY_INLINE bool both(bool a, bool b) { return a && b; }
[[nodiscard]] HWY_INLINE bool either(bool a, bool b) { return a || b; }
[[nodiscard]] HWY_INLINE float select(bool mask, float yes, float no) { return mask ? yes : no; }
[[nodiscard]] HWY_INLINE float smaller(float a, float b) { return a < b ? a : b; }
[[nodiscard]] HWY_INLINE float larger(float a, float b) { return a > b ? a : b; }
[[nodiscard]] HWY_INLINE float magnitude(float a) { return std::abs(a); }
/// `a`, its sign flipped where `by` is negative (-0 is).
[[nodiscard]] HWY_INLINE float flip_sign(float a, float by) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(a) ^
                                (std::bit_cast<std::uint32_t>(by) & 0x8000'0000U));
}
/// Whether the sign bits are equal.
[[nodiscard]] HWY_INLINE bool has_same_sign(float a, float b) { return std::signbit(a) == std::signbit(b); }
[[nodiscard]] HWY_INLINE bool has_same_sign(float a, float b, float c) {
    const auto bits_a = std::bit_cast<std::uint32_t>(a), bits_b = std::bit_cast<std::uint32_t>(b),
               bits_c = std::bit_cast<std::uint32_t>(c);
    return (((bits_a ^ bits_b) | (bits_b ^ bits_c)) & 0x8000'0000U) == 0;  // one branch, not two
}

template <class Real>
struct Vector {
    Real c[3];
    [[nodiscard]] HWY_INLINE const Real& operator[](int axis) const { return c[axis]; }
};

template <class Real>
[[nodiscard]] HWY_INLINE Vector<Real> operator-(const Vector<Real>& a, const Vector<Real>& b) {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class Real>
[[nodiscard]] HWY_INLINE Vector<Real> operator+(const Vector<Real>& a, const Vector<Real>& b) {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class Real>
[[nodiscard]] HWY_INLINE Vector<Real> operator*(const Vector<Real>& a, const Real& s) {
    return {{a[0] * s, a[1] * s, a[2] * s}};
}
template <class Real>
[[nodiscard]] HWY_INLINE Real dot(const Vector<Real>& a, const Vector<Real>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real>
[[nodiscard]] HWY_INLINE Vector<Real> cross(const Vector<Real>& a, const Vector<Real>& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// An axis that is the same in all lanes: 0, 1 or 2.
struct Axis {
    int index = 0;
};
/// Component axis + Shift (modulo 3) of `v`.
template <int Shift, class Real>
[[nodiscard]] HWY_INLINE const Real& pick(Axis axis, const Vector<Real>& v) {
    return v[(axis.index + Shift) % 3];
}

/// The same, known when compiled.
template <int Index>
struct StaticAxis {};
template <int Shift, class Real, int Index>
[[nodiscard]] HWY_INLINE const Real& pick(StaticAxis<Index>, const Vector<Real>& v) {
    return v[(Index + Shift) % 3];
}

/// The axis of a vector's largest component by magnitude; the first of equals.
template <class Real>
[[nodiscard]] Axis largest_axis(const Vector<Real>& v) {
    const Real x = magnitude(v[0]), y = magnitude(v[1]), z = magnitude(v[2]);
    if (x >= y && x >= z) return {0};
    return {y >= z ? 1 : 2};
}

// The next two are for scalars; lanes-inl.hpp has them for lanes. Numbers of up to 24 bits whose squares are
// in binary64's range multiply there without rounding.

/// x1 y2 - y1 x2, rounded once.
template <class Real>
[[nodiscard]] Real edge_function_in_double(const Real& x1, const Real& y1, const Real& x2, const Real& y2) {
    return static_cast<Real>(static_cast<double>(x1) * static_cast<double>(y2) -
                             static_cast<double>(y1) * static_cast<double>(x2));
}
/// The same; its sign bit is the exact sign, and that of an exact zero is the sign for an origin moved by
/// (e, e^2), e infinitely small and positive. Swapping the points swaps the sign, unless they are the same.
template <class Real>
[[nodiscard]] Real owned_edge_function(const Real& x1, const Real& y1, const Real& x2, const Real& y2) {
    const Real zero(0.0F);
    const double exact =
        static_cast<double>(x1) * static_cast<double>(y2) - static_cast<double>(y1) * static_cast<double>(x2);
    if (exact < 0 || exact > 0) return static_cast<Real>(exact);
    return y1 < y2 || (y1 == y2 && x1 > x2) ? -zero : zero;
}

/// Whether a ray may hit the triangle at all: its corners are finite and not on one line, without rounding.
/// Decided for binary32; any other Real is taken to be able.
template <class Real>
[[nodiscard]] bool can_be_hit(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c) {
    if constexpr (std::is_same_v<Real, float>) {
        const Vec3 p{a[0], a[1], a[2]}, q{b[0], b[1], b[2]}, r{c[0], c[1], c[2]};
        return is_finite(p) && is_finite(q) && is_finite(r) && !is_collinear(p, q, r);
    } else {
        return true;
    }
}
template <class Real>
[[nodiscard]] Vector<Real> nowhere() {
    const Real nan(std::numeric_limits<float>::quiet_NaN());
    return {{nan, nan, nan}};
}

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
