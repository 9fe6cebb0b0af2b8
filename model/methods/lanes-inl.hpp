// W binary32 numbers in a vector of the instruction set (Highway): the Real of the SIMD forms.

#include <cstddef>
#include <cstdint>

#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of this set hold at most this many.
#if HWY_TARGET == HWY_SCALAR
inline constexpr std::size_t most_lanes = 1;
#else
inline constexpr std::size_t most_lanes = HWY_MAX_BYTES / sizeof(float);
#endif

template <std::size_t W>
using LanesTag = hn::FixedTag<float, W>;

template <std::size_t W>
struct LaneMask {
    hn::Mask<LanesTag<W>> bits;
};

template <std::size_t W>
struct Lanes {
    hn::Vec<LanesTag<W>> v;
    Lanes() = default;
    HWY_INLINE explicit Lanes(float value) : v(hn::Set(LanesTag<W>(), value)) {}
    HWY_INLINE explicit Lanes(hn::Vec<LanesTag<W>> vector) : v(vector) {}
    /// From W numbers aligned to their size.
    [[nodiscard]] static HWY_INLINE Lanes load(const float* from) {
        return Lanes(hn::Load(LanesTag<W>(), from));
    }
    HWY_INLINE void store(float* to) const { hn::Store(v, LanesTag<W>(), to); }

    [[nodiscard]] friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
    [[nodiscard]] friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
    [[nodiscard]] friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
    [[nodiscard]] friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.v, b.v)); }
    [[nodiscard]] friend HWY_INLINE Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.v)); }
    [[nodiscard]] friend HWY_INLINE LaneMask<W> operator==(Lanes a, Lanes b) { return {hn::Eq(a.v, b.v)}; }
    [[nodiscard]] friend HWY_INLINE LaneMask<W> operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
    [[nodiscard]] friend HWY_INLINE LaneMask<W> operator>(Lanes a, Lanes b) { return {hn::Gt(a.v, b.v)}; }
    [[nodiscard]] friend HWY_INLINE LaneMask<W> operator<=(Lanes a, Lanes b) { return {hn::Le(a.v, b.v)}; }
    [[nodiscard]] friend HWY_INLINE LaneMask<W> operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
};

template <std::size_t W>
[[nodiscard]] HWY_INLINE bool is_none(LaneMask<W> mask) {
    return hn::AllFalse(LanesTag<W>(), mask.bits);
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE bool is_all(LaneMask<W> mask) {
    return hn::AllTrue(LanesTag<W>(), mask.bits);
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE LaneMask<W> inverted(LaneMask<W> mask) {
    return {hn::Not(mask.bits)};
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE LaneMask<W> both(LaneMask<W> a, LaneMask<W> b) {
    return {hn::And(a.bits, b.bits)};
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE LaneMask<W> either(LaneMask<W> a, LaneMask<W> b) {
    return {hn::Or(a.bits, b.bits)};
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> select(LaneMask<W> mask, Lanes<W> yes, Lanes<W> no) {
    return Lanes<W>(hn::IfThenElse(mask.bits, yes.v, no.v));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> smaller(Lanes<W> a, Lanes<W> b) {
    return Lanes<W>(hn::Min(a.v, b.v));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> larger(Lanes<W> a, Lanes<W> b) {
    return Lanes<W>(hn::Max(a.v, b.v));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> magnitude(Lanes<W> a) {
    return Lanes<W>(hn::Abs(a.v));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> flip_sign(Lanes<W> a, Lanes<W> by) {
    const LanesTag<W> d;
    return Lanes<W>(hn::Xor(a.v, hn::And(by.v, hn::SignBit(d))));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE LaneMask<W> has_same_sign(Lanes<W> a, Lanes<W> b) {
    const LanesTag<W> d;
    const hn::RebindToSigned<LanesTag<W>> signed_tag;
    const auto differs = hn::BitCast(signed_tag, hn::Xor(a.v, b.v));
    return {hn::Not(hn::RebindMask(d, hn::Lt(differs, hn::Zero(signed_tag))))};
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE LaneMask<W> has_same_sign(Lanes<W> a, Lanes<W> b, Lanes<W> c) {
    const Lanes<W> zero(0.0F);
    return has_same_sign(Lanes<W>(hn::Or(hn::Xor(a.v, b.v), hn::Xor(b.v, c.v))), zero);
}

/// x1 y2 - y1 x2 in binary64 and rounded to binary32; `zero` where it is exactly zero.
template <std::size_t H, class V = hn::Vec<LanesTag<H>>>
[[nodiscard]] HWY_INLINE V rounded_edge_function(V x1, V y1, V x2, V y2, V zero) {
    const hn::FixedTag<double, H> d;
    const auto value = hn::Sub(hn::Mul(hn::PromoteTo(d, x1), hn::PromoteTo(d, y2)),
                               hn::Mul(hn::PromoteTo(d, y1), hn::PromoteTo(d, x2)));
    const auto is_zero = hn::Eq(value, hn::Zero(d));
    return hn::DemoteTo(LanesTag<H>(), hn::IfThenElse(is_zero, hn::PromoteTo(d, zero), value));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> rounded_edge_function(Lanes<W> x1, Lanes<W> y1, Lanes<W> x2, Lanes<W> y2,
                                                        Lanes<W> zero) {
#if HWY_TARGET == HWY_SCALAR
    return Lanes<W>(rounded_edge_function<W>(x1.v, y1.v, x2.v, y2.v, zero.v));
#else
    const LanesTag<W / 2> half;
    const auto lower = rounded_edge_function<W / 2>(hn::LowerHalf(half, x1.v), hn::LowerHalf(half, y1.v),
                                                    hn::LowerHalf(half, x2.v), hn::LowerHalf(half, y2.v),
                                                    hn::LowerHalf(half, zero.v));
    const auto upper = rounded_edge_function<W / 2>(hn::UpperHalf(half, x1.v), hn::UpperHalf(half, y1.v),
                                                    hn::UpperHalf(half, x2.v), hn::UpperHalf(half, y2.v),
                                                    hn::UpperHalf(half, zero.v));
    return Lanes<W>(hn::Combine(LanesTag<W>(), upper, lower));
#endif
}

// As numeric-inl.hpp has them for scalars.
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> edge_function_in_double(Lanes<W> x1, Lanes<W> y1, Lanes<W> x2,
                                                          Lanes<W> y2) {
    return rounded_edge_function(x1, y1, x2, y2, Lanes<W>(0.0F));
}
template <std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> owned_edge_function(Lanes<W> x1, Lanes<W> y1, Lanes<W> x2, Lanes<W> y2) {
    const Lanes<W> owner = select(y1 == y2, x2 - x1, y1 - y2);
    return rounded_edge_function(x1, y1, x2, y2, flip_sign(Lanes<W>(0.0F), owner));
}

/// An axis in each lane.
template <std::size_t W>
struct LaneAxis {
    LaneMask<W> is_x, is_y;
    /// From W axes as numbers 0, 1, 2, aligned to their size.
    [[nodiscard]] static HWY_INLINE LaneAxis load(const float* axes) {
        const Lanes<W> axis = Lanes<W>::load(axes);
        return {axis < Lanes<W>(0.5F), both(axis > Lanes<W>(0.5F), axis < Lanes<W>(1.5F))};
    }
};
template <int Shift, std::size_t W>
[[nodiscard]] HWY_INLINE Lanes<W> pick(const LaneAxis<W>& axis, const Vector<Lanes<W>>& v) {
    return select(axis.is_x, v[Shift % 3], select(axis.is_y, v[(1 + Shift) % 3], v[(2 + Shift) % 3]));
}

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
