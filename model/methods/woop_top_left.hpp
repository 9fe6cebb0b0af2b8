#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Ours: Woop's shear, but each edge decided exactly in the sheared plane and owned by one triangle.
///
/// An edge function is a difference of two products. Rounding keeps order, so of two rounded products that
/// differ the greater is the greater: their comparison is the exact sign, however a compiler may contract the
/// difference. Where they are equal, rarely, the sign is that of binary64, in which the products are exact,
/// and an exact zero goes by the edge's direction, as if the ray were moved a little (top-left rule).
/// Reversing an edge reverses its answer, and a vertex is sheared to the same numbers in all its triangles:
/// of the triangles around an edge or a vertex that the ray passes through exactly one is hit, or two or none
/// at a silhouette.
///
/// Never hit: triangles with NaN or infinity, exactly degenerate ones (as [DXR] asks; a mesh closed by
/// triangles of three corners on a line has holes then), hits at t of 2^127 and more. Every t, u, v of a hit
/// is finite. Fails where edge functions leave the range of binary32: triangles of less than 1e-19 or more
/// than 1e18 as the ray sees them; and a ray whose largest direction component is below 2^-126 hits nothing.
/// The sheared vertices are rounded, so that a hit beside an edge may go to the neighbour.
///
/// A pair gives bit for bit what its triangles give.
struct WoopTopLeft : Woop {
    static constexpr MethodInfo info{.name = "woop_top_left",
                                     .title = "rtusim, top-left",
                                     .source = "docs/methods.md, after [WBW13]",
                                     .stored_bytes = 36,
                                     .axis_owner = AxisOwner::Ray};

    /// An edge function, plus - minus, from a point to another. Of the reversed edge the two are swapped.
    template <class Real>
    struct Edge {
        Real plus, minus;
    };

    /// A triangle that must not be hit is stored as NaN.
    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        if (!can_be_hit(a, b, c)) return {nowhere<Real>(), nowhere<Real>(), nowhere<Real>()};
        return {a, b, c};
    }
    template <class Real>
    [[nodiscard]] static PairStored<Real> store_pair(const Vector<Real>& a, const Vector<Real>& b,
                                                     const Vector<Real>& c, const Vector<Real>& d, Axis) {
        PairStored<Real> stored{a, b, c, d};
        if (!can_be_hit(a, b, c)) stored.b = nowhere<Real>();
        if (!can_be_hit(a, c, d)) stored.d = nowhere<Real>();
        return stored;
    }

    template <class Real>
    [[nodiscard]] static HWY_INLINE Edge<Real> edge(const Sheared<Real>& p, const Sheared<Real>& q) {
        return {p.x * q.y, p.y * q.x};
    }
    /// `value`, the edge function; of a tie with the sign of who owns it.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real settled(const Edge<Real>& edge, const Real& value,
                                                 const Sheared<Real>& from, const Sheared<Real>& to) {
        return select(edge.plus == edge.minus, owned_edge_function(from.x, from.y, to.x, to.y), value);
    }

    /// From edge functions whose signs are settled.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Candidate<Real> at_depth(const RayData<Real>& ray,
                                                             const Interval<Real>& interval,
                                                             const MaskOf<Real>& is_in, const Real& by_p,
                                                             const Real& by_q, const Real& by_r,
                                                             const Sheared<Real>& p, const Sheared<Real>& q,
                                                             const Sheared<Real>& r) {
        const Real det = by_p + by_q + by_r;
        const Real t = (by_p * p.z + by_q * q.z + by_r * r.z) * ray.scale_z;
        const Real size = magnitude(det), distance = flip_sign(t, det);
        const Interval<Real> finite{interval.t_min, smaller(Real(0x1p127F), interval.t_max)};
        const MaskOf<Real> is_hit = both(is_within(finite, distance, size), size >= Real(0x1p-126F));
        return {both(is_in, is_hit), t, by_q, by_r, det};
    }

    /// Each edge named by the corner opposite to it.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Candidate<Real> decide(const RayData<Real>& ray,
                                                           const Interval<Real>& interval,
                                                           const Edge<Real>& of_p, const Edge<Real>& of_q,
                                                           const Edge<Real>& of_r, const Sheared<Real>& p,
                                                           const Sheared<Real>& q, const Sheared<Real>& r) {
        const MaskOf<Real> is_tie =
            either(either(of_p.plus == of_p.minus, of_q.plus == of_q.minus), of_r.plus == of_r.minus);
        Real by_p = of_p.plus - of_p.minus, by_q = of_q.plus - of_q.minus, by_r = of_r.plus - of_r.minus;
        if (HWY_UNLIKELY(!is_none(is_tie))) {
            by_p = settled(of_p, by_p, q, r);
            by_q = settled(of_q, by_q, r, p);
            by_r = settled(of_r, by_r, p, q);
        }
        const MaskOf<Real> is_in = has_same_sign(by_p, by_q, by_r);
        if constexpr (std::is_same_v<MaskOf<Real>, bool>)
            if (!is_in) return {is_in};
        return at_depth(ray, interval, is_in, by_p, by_q, by_r, p, q, r);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& triangle, AnyAxis axis) {
        const Sheared<Real> a = shear(ray, triangle.a, axis);
        const Sheared<Real> b = shear(ray, triangle.b, axis);
        const Sheared<Real> c = shear(ray, triangle.c, axis);
        return decide(ray, interval, edge(b, c), edge(c, a), edge(a, b), a, b, c);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair,
                                                                  AnyAxis axis) {
        const Sheared<Real> a = shear(ray, pair.a, axis);
        const Sheared<Real> b = shear(ray, pair.b, axis);
        const Sheared<Real> c = shear(ray, pair.c, axis);
        const Sheared<Real> d = shear(ray, pair.d, axis);
        const Edge<Real> ca = edge(c, a), ac{ca.minus, ca.plus};
        return {decide(ray, interval, edge(b, c), ca, edge(a, b), a, b, c),
                decide(ray, interval, edge(c, d), edge(d, a), ac, a, c, d)};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
