#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The ray transformed to where the triangle is (0,0,0), (1,0,0), (0,1,0), by an affine map whose third axis
/// is free and so chosen that nine numbers hold it; [BW16] section 3. These are Wald's forms, one sign less.
/// Map and forms are seen from the world's origin: far from it all accuracy is lost. Edges belong to both
/// neighbours or to neither.
struct BaldwinWeber : RayAsGiven, EarlyDivision {
    static constexpr MethodInfo info{.name = "baldwin_weber",
                                     .title = "Baldwin-Weber",
                                     .source = "[BW16] section 3",
                                     .stored_bytes = 36,
                                     .axis_owner = AxisOwner::Triangle};
    /// Rows of the map without the column of the axis k, whose entries are 0, 0 and 1; p and q are the axes
    /// after k.
    template <class Real>
    struct Stored {
        Real u_p, u_q, u_d;
        Real v_p, v_q, v_d;
        Real w_p, w_q, w_d;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis axis) {
        const Vector<Real> ab = b - a, ac = c - a, n = cross(ab, ac);
        const Real inverse = Real(1.0F) / pick<0>(axis, n);
        const Real a_p = pick<1>(axis, a), a_q = pick<2>(axis, a);
        const Real b_p = pick<1>(axis, b), b_q = pick<2>(axis, b);
        const Real c_p = pick<1>(axis, c), c_q = pick<2>(axis, c);
        return {pick<2>(axis, ac) * inverse,  -pick<1>(axis, ac) * inverse, (c_p * a_q - c_q * a_p) * inverse,
                -pick<2>(axis, ab) * inverse, pick<1>(axis, ab) * inverse,  (b_q * a_p - b_p * a_q) * inverse,
                pick<1>(axis, n) * inverse,   pick<2>(axis, n) * inverse,   -dot(n, a) * inverse};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis axis) {
        const Real zero(0.0F), one(1.0F);
        const Real o_p = pick<1>(axis, ray.origin), o_q = pick<2>(axis, ray.origin);
        const Real d_p = pick<1>(axis, ray.direction), d_q = pick<2>(axis, ray.direction);
        const Real origin_w = pick<0>(axis, ray.origin) + f.w_p * o_p + f.w_q * o_q + f.w_d;
        const Real direction_w = pick<0>(axis, ray.direction) + f.w_p * d_p + f.w_q * d_q;
        const Real t = -origin_w / direction_w;
        MaskOf<Real> is_hit = is_within(interval, t);
        if (is_none(is_hit)) return {is_hit};
        const Real p = o_p + t * d_p, q = o_q + t * d_q;
        const Real u = f.u_p * p + f.u_q * q + f.u_d;
        is_hit = both(is_hit, both(u >= zero, u <= one));
        if (is_none(is_hit)) return {is_hit};
        const Real v = f.v_p * p + f.v_q * q + f.v_d;
        return {both(is_hit, both(v >= zero, u + v <= one)), t, u, v, one};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
