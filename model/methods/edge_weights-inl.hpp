#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Signed volumes that the ray makes with a triangle's edges, named by the corner opposite to the edge: their
/// shares of their sum are that corner's weights.
template <class Real>
struct EdgeWeights {
    Real of_a, of_b, of_c;
};

/// Whether none is negative, or none positive.
template <class Real>
[[nodiscard]] HWY_INLINE MaskOf<Real> is_on_one_side(const EdgeWeights<Real>& w) {
    const Real zero(0.0F);
    return either(both(both(w.of_a >= zero, w.of_b >= zero), w.of_c >= zero),
                  both(both(w.of_a <= zero, w.of_b <= zero), w.of_c <= zero));
}

/// The end of a test whose edges let the lanes of `is_in` pass: t from the plane, in which det t = t_det.
/// Where all weights round to zero, u and v are NaN.
template <class Real>
[[nodiscard]] HWY_INLINE Candidate<Real> meet_plane(const MaskOf<Real>& is_in, const Interval<Real>& interval,
                                                    const Real& det, const Real& t_det,
                                                    const EdgeWeights<Real>& w) {
    const Real size = magnitude(det), distance = flip_sign(t_det, det);
    return {both(is_in, is_within(interval, distance, size)),
            distance,
            w.of_b,
            w.of_c,
            size,
            w.of_a + w.of_b + w.of_c};
}
/// The same, the plane being that of a and b, seen from the ray's origin, and to_c = c - a.
template <class Real>
[[nodiscard]] HWY_INLINE Candidate<Real> meet_plane(const Vector<Real>& direction, const MaskOf<Real>& is_in,
                                                    const Interval<Real>& interval, const Vector<Real>& a,
                                                    const Vector<Real>& b, const Vector<Real>& to_c,
                                                    const EdgeWeights<Real>& weights) {
    if (is_none(is_in)) return {is_in};
    const Vector<Real> normal = cross(b - a, to_c);
    return meet_plane(is_in, interval, dot(normal, direction), dot(normal, a), weights);
}

/// Both triangles of a pair; the normal of the second is turned round, which changes nothing.
template <class Real>
[[nodiscard]] HWY_INLINE PairCandidate<Real> meet_planes(const Vector<Real>& direction,
                                                         const Interval<Real>& interval,
                                                         const Vector<Real>& a, const Vector<Real>& b,
                                                         const Vector<Real>& c, const Vector<Real>& d,
                                                         const EdgeWeights<Real>& first,
                                                         const EdgeWeights<Real>& second) {
    const MaskOf<Real> is_in_first = is_on_one_side(first), is_in_second = is_on_one_side(second);
    if (is_none(either(is_in_first, is_in_second))) return {{is_in_first}, {is_in_second}};
    const Vector<Real> to_c = c - a;
    return {meet_plane(direction, is_in_first, interval, a, b, to_c, first),
            meet_plane(direction, is_in_second, interval, a, d, to_c, second)};
}

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
