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

/// Lane by lane, slowly: edge_function_in_double and owned_edge_function.
template <std::size_t W>
[[nodiscard]] HWY_NOINLINE Lanes<W> edge_function_in_double(Lanes<W> x1, Lanes<W> y1, Lanes<W> x2,
                                                            Lanes<W> y2) {
    HWY_ALIGN float x[2][W], y[2][W], result[W];
    x1.store(x[0]), y1.store(y[0]), x2.store(x[1]), y2.store(y[1]);
    for (std::size_t i = 0; i < W; ++i)
        result[i] = edge_function_in_double(x[0][i], y[0][i], x[1][i], y[1][i]);
    return Lanes<W>::load(result);
}
template <std::size_t W>
[[nodiscard]] HWY_NOINLINE Lanes<W> owned_edge_function(Lanes<W> x1, Lanes<W> y1, Lanes<W> x2, Lanes<W> y2) {
    HWY_ALIGN float x[2][W], y[2][W], result[W];
    x1.store(x[0]), y1.store(y[0]), x2.store(x[1]), y2.store(y[1]);
    for (std::size_t i = 0; i < W; ++i) result[i] = owned_edge_function(x[0][i], y[0][i], x[1][i], y[1][i]);
    return Lanes<W>::load(result);
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
