#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Moller-Trumbore with the division after all tests, as in the second of the variants in [MOL00]: numerators
/// are compared with the determinant. A zero determinant is no hit. Fails at edges and vertices as the other.
///
/// The pair is anchored at a, the corner that both triangles have first: direction x (c - a) and its product
/// with origin - a, the weight at the common edge, are computed once, and the second triangle is tested as
/// (a, d, c). It gives bit for bit what (a, b, c) and (a, d, c) give alone, u and v of the latter swapped;
/// what (a, c, d) gives alone differs by rounding.
struct MollerTrumboreDeferred : RayAsGiven, DeferredDivision {
    static constexpr MethodInfo info{.name = "moller_trumbore_deferred",
                                     .title = "Moller-Trumbore, deferred",
                                     .source = "[MT97] eq. 6, [MOL00]",
                                     .stored_bytes = 36,
                                     .is_pair_reversed = true};
    static constexpr bool has_pair = true;

    template <class Real>
    struct Stored {
        Vector<Real> a, edge_1, edge_2;
    };
    template <class Real>
    struct PairStored {
        Vector<Real> a, to_b, to_c, to_d;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b - a, c - a};
    }

    template <class Real>
    [[nodiscard]] static PairStored<Real> store_pair(const Vector<Real>& a, const Vector<Real>& b,
                                                     const Vector<Real>& c, const Vector<Real>& d, Axis) {
        return {a, b - a, c - a, d - a};
    }

    /// Goes on from the determinant and u times it.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Candidate<Real> decide(const Vector<Real>& direction,
                                                           const Interval<Real>& interval,
                                                           const Vector<Real>& s, const Real& det,
                                                           const Real& u_det, const Vector<Real>& edge_1,
                                                           const Vector<Real>& edge_2) {
        const Real zero(0.0F);
        const Real size = magnitude(det), u = flip_sign(u_det, det);
        MaskOf<Real> is_hit = both(u >= zero, u <= size);
        if (is_none(is_hit)) return {is_hit};
        const Vector<Real> q = cross(s, edge_1);
        const Real v = flip_sign(dot(direction, q), det);
        is_hit = both(is_hit, both(v >= zero, u + v <= size));
        if (is_none(is_hit)) return {is_hit};
        const Real t = flip_sign(dot(edge_2, q), det);
        return {both(is_hit, is_within(interval, t, size)), t, u, v, size};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Vector<Real> p = cross(ray.direction, f.edge_2), s = ray.origin - f.a;
        return decide(ray.direction, interval, s, dot(f.edge_1, p), dot(s, p), f.edge_1, f.edge_2);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair, AnyAxis) {
        const Vector<Real> p = cross(ray.direction, pair.to_c), s = ray.origin - pair.a;
        const Real common = dot(s, p);
        const auto first =
            decide(ray.direction, interval, s, dot(pair.to_b, p), common, pair.to_b, pair.to_c);
        const auto second =
            decide(ray.direction, interval, s, dot(pair.to_d, p), common, pair.to_d, pair.to_c);
        return {first, {second.is_hit, second.t, second.v, second.u, second.det}};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
