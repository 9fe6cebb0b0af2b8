// What a method's arithmetic is made of. A method is a template over Real: binary32, one of Highway's vectors
// (Lanes), a type that counts operations, or one that rounds to a narrower format. A comparison gives a Mask:
// bool, or one bit a lane.

#include <bit>
#include <cmath>
#include <cstdint>

#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

template <class Real>
using MaskOf = decltype(Real(0.0F) < Real(0.0F));

[[nodiscard]] HWY_INLINE bool is_none(bool mask) { return !mask; }
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

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
