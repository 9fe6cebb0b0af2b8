#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The distance to the plane first, then the hit point projected along the normal's largest component k and
/// its weights as linear forms of the two other coordinates; eq. 5 to 7 of [HH11], which restate [WAL04].
/// Plane and forms are seen from the world's origin, so that far from it all accuracy is lost.
struct Wald : EarlyDivision {
    static constexpr MethodInfo info{.name = "wald",
                                     .title = "Wald",
                                     .source = "[WAL04], [HH11] eq. 5-7",
                                     .stored_bytes = 36,
                                     .axis_owner = AxisOwner::Triangle};
    template <class Real>
    struct RayData {
        Vector<Real> origin, direction;
    };
    /// Plane: x[k] + n_p x[p] + n_q x[q] = d, with p and q the axes after k.
    template <class Real>
    struct Stored {
        Real n_p, n_q, d;
        Real u_p, u_q, u_d;
        Real v_p, v_q, v_d;
    };

    template <class Real>
    [[nodiscard]] static RayData<Real> prepare(const Vector<Real>& origin, const Vector<Real>& direction,
                                               Axis) {
        return {origin, direction};
    }
    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis axis) {
        const Vector<Real> ab = b - a, ac = c - a;
        const Vector<Real> n = cross(ab, ac);
        const Real inverse = Real(1.0F) / pick<0>(axis, n);  // also 1 / (ab_p ac_q - ab_q ac_p)
        const Real a_p = pick<1>(axis, a), a_q = pick<2>(axis, a);
        const Real n_p = pick<1>(axis, n) * inverse, n_q = pick<2>(axis, n) * inverse;
        const Real u_p = pick<2>(axis, ac) * inverse, u_q = -pick<1>(axis, ac) * inverse;
        const Real v_p = -pick<2>(axis, ab) * inverse, v_q = pick<1>(axis, ab) * inverse;
        return {n_p, n_q, pick<0>(axis, a) + n_p * a_p + n_q * a_q,
                u_p, u_q, -(a_p * u_p + a_q * u_q),
                v_p, v_q, -(a_p * v_p + a_q * v_q)};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis axis) {
        const Real zero(0.0F), one(1.0F);
        const auto& o = ray.origin;
        const auto& d = ray.direction;
        const Real o_p = pick<1>(axis, o), o_q = pick<2>(axis, o);
        const Real d_p = pick<1>(axis, d), d_q = pick<2>(axis, d);
        const Real inverse = one / (pick<0>(axis, d) + f.n_p * d_p + f.n_q * d_q);
        const Real t = (f.d - pick<0>(axis, o) - f.n_p * o_p - f.n_q * o_q) * inverse;
        MaskOf<Real> is_hit = both(t > interval.t_min, t < interval.t_max);
        if (is_none(is_hit)) return {is_hit};
        const Real p = o_p + t * d_p, q = o_q + t * d_q;
        const Real u = p * f.u_p + q * f.u_q + f.u_d;
        is_hit = both(is_hit, u >= zero);
        if (is_none(is_hit)) return {is_hit};
        const Real v = p * f.v_p + q * f.v_q + f.v_d;
        is_hit = both(is_hit, both(v >= zero, u + v <= one));
        return {is_hit, t, u, v, one};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
