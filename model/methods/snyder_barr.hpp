#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The distance to the plane first, then the weight of each corner as the area of the triangle that the hit
/// point makes with the opposite edge, projected along the normal's largest component; [SB87] section 4.
/// The plane is seen from the world's origin: far from it, and on slivers, its rounding decides. Edges belong
/// to both neighbours or to neither.
struct SnyderBarr : RayAsGiven, EarlyDivision {
    static constexpr MethodInfo info{.name = "snyder_barr",
                                     .title = "Snyder-Barr",
                                     .source = "[SB87] section 4",
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

    /// Twice the projected area of (p, q) with the edge from x to y.
    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Real area(const Vector<Real>& x, const Vector<Real>& y, const Real& p,
                                              const Real& q, AnyAxis axis) {
        const Real x_p = pick<1>(axis, x), x_q = pick<2>(axis, x);
        return (pick<1>(axis, y) - x_p) * (q - x_q) - (pick<2>(axis, y) - x_q) * (p - x_p);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis axis) {
        const Real zero(0.0F), one(1.0F);
        const Real t = (f.d - dot(f.normal, ray.origin)) / dot(f.normal, ray.direction);
        MaskOf<Real> is_hit = is_within(interval, t);
        if (is_none(is_hit)) return {is_hit};
        const Real p = pick<1>(axis, ray.origin) + t * pick<1>(axis, ray.direction);
        const Real q = pick<2>(axis, ray.origin) + t * pick<2>(axis, ray.direction);
        const Real inverse = one / pick<0>(axis, f.normal);
        const Real u = area(f.c, f.a, p, q, axis) * inverse;
        is_hit = both(is_hit, u >= zero);
        if (is_none(is_hit)) return {is_hit};
        const Real v = area(f.a, f.b, p, q, axis) * inverse;
        is_hit = both(is_hit, v >= zero);
        if (is_none(is_hit)) return {is_hit};
        const Real w = area(f.b, f.c, p, q, axis) * inverse;
        return {both(is_hit, w >= zero), t, u, v, one};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
