#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The distance to the plane first, then the hit point's weights by substitution in the plane of projection,
/// one after the other; [BAD90], restated as eq. 1 to 3 of [RS04]. Where the first edge has no extent on the
/// first axis of the projection, the second serves; the paper has another formula there for the first weight,
/// which differs by rounding only. Fails as Snyder-Barr does, and divides by that extent however small it is.
struct Badouel : RayAsGiven, EarlyDivision {
    static constexpr MethodInfo info{.name = "badouel",
                                     .title = "Badouel",
                                     .source = "[BAD90], [RS04] eq. 1-3",
                                     .stored_bytes = 52,
                                     .axis_owner = AxisOwner::Triangle};
    /// Plane: normal . x = d.
    template <class Real>
    struct Stored {
        Vector<Real> normal;
        Real d;
        Vector<Real> a, b, c;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        const Vector<Real> normal = cross(b - a, c - a);
        return {normal, dot(normal, a), a, b, c};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis axis) {
        const Real zero(0.0F), one(1.0F);
        const Real t = (f.d - dot(f.normal, ray.origin)) / dot(f.normal, ray.direction);
        MaskOf<Real> is_hit = is_within(interval, t);
        if (is_none(is_hit)) return {is_hit};
        const Real a_p = pick<1>(axis, f.a), a_q = pick<2>(axis, f.a);
        const Real p = pick<1>(axis, ray.origin) + t * pick<1>(axis, ray.direction) - a_p;
        const Real q = pick<2>(axis, ray.origin) + t * pick<2>(axis, ray.direction) - a_q;
        const Real b_p = pick<1>(axis, f.b) - a_p, b_q = pick<2>(axis, f.b) - a_q;
        const Real c_p = pick<1>(axis, f.c) - a_p, c_q = pick<2>(axis, f.c) - a_q;
        const Real v = (q * b_p - p * b_q) / (c_q * b_p - c_p * b_q);
        is_hit = both(is_hit, both(v >= zero, v <= one));
        if (is_none(is_hit)) return {is_hit};
        const MaskOf<Real> has_no_extent = b_p == zero;
        const Real point = select(has_no_extent, q, p), of_c = select(has_no_extent, c_q, c_p);
        const Real u = (point - v * of_c) / select(has_no_extent, b_q, b_p);
        return {both(is_hit, both(u >= zero, u + v <= one)), t, u, v, one};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
