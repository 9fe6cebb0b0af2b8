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

    /// An edge function: plus - minus. Of the reversed edge the two are swapped.
    template <class Real>
    struct Edge {
        Real plus, minus;
    };

    /// A triangle that must not be hit is stored as NaN.
    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b, can_be_hit(a, b, c) ? c : nowhere<Real>()};
    }
    template <class Real>
    [[nodiscard]] static PairStored<Real> store_pair(const Vector<Real>& a, const Vector<Real>& b,
                                                     const Vector<Real>& c, const Vector<Real>& d, Axis) {
        return {a, can_be_hit(a, b, c) ? b : nowhere<Real>(), c, can_be_hit(a, c, d) ? d : nowhere<Real>()};
    }

    template <class Real>
    [[nodiscard]] static HWY_INLINE Edge<Real> edge(const Sheared<Real>& p, const Sheared<Real>& q) {
        return {p.x * q.y, p.y * q.x};
    }
    /// The edge function from p to q; of a tie with the sign of who owns it.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real settle(const Edge<Real>& edge, const Sheared<Real>& p,
                                                const Sheared<Real>& q) {
        return select(edge.plus == edge.minus, owned_edge_function(p.x, p.y, q.x, q.y),
                      edge.plus - edge.minus);
    }

    template <class Real>
    [[nodiscard]] static HWY_INLINE Candidate<Real> decide(const RayData<Real>& ray,
                                                           const Interval<Real>& interval,
                                                           const Edge<Real>& qr, const Edge<Real>& rp,
                                                           const Edge<Real>& pq, const Sheared<Real>& p,
                                                           const Sheared<Real>& q, const Sheared<Real>& r) {
        MaskOf<Real> is_in =
            either(both(both(qr.plus >= qr.minus, rp.plus >= rp.minus), pq.plus >= pq.minus),
                   both(both(qr.plus <= qr.minus, rp.plus <= rp.minus), pq.plus <= pq.minus));
        if (is_none(is_in)) return {is_in};
        Real of_p = qr.plus - qr.minus, of_q = rp.plus - rp.minus, of_r = pq.plus - pq.minus;
        const MaskOf<Real> is_tie =
            either(either(qr.plus == qr.minus, rp.plus == rp.minus), pq.plus == pq.minus);
        if (!is_none(both(is_in, is_tie))) {
            of_p = settle(qr, q, r);
            of_q = settle(rp, r, p);
            of_r = settle(pq, p, q);
            is_in = both(is_in, both(has_same_sign(of_p, of_q), has_same_sign(of_q, of_r)));
        }
        const Real det = of_p + of_q + of_r;
        const Real t = (of_p * p.z + of_q * q.z + of_r * r.z) * ray.scale_z;
        const Real size = magnitude(det), distance = flip_sign(t, det);
        const MaskOf<Real> is_finite = both(size >= Real(0x1p-126F), distance < Real(0x1p127F) * size);
        return {both(both(is_in, is_finite), is_within(interval, distance, size)), t, of_q, of_r, det};
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
