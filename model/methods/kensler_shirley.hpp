#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Cramer's rule with the normal, computed on the fly, as the common factor, t before u and v, which is the
/// cheapest order of those searched by [KS06]; divided last. Edges as in Moller-Trumbore: both neighbours may
/// miss or hit.
struct KenslerShirley : RayAsGiven, DeferredDivision {
    static constexpr MethodInfo info{.name = "kensler_shirley",
                                     .title = "Kensler-Shirley",
                                     .source = "[KS06] section 3",
                                     .stored_bytes = 36};
    template <class Real>
    struct Stored {
        Vector<Real> a, edge_1, edge_2;  // b - a and a - c
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b - a, a - c};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Real zero(0.0F);
        const Vector<Real> normal = cross(f.edge_2, f.edge_1), s = f.a - ray.origin;
        const Real det = dot(normal, ray.direction), size = magnitude(det);
        const Real t = flip_sign(dot(normal, s), det);
        MaskOf<Real> is_hit = is_within(interval, t, size);
        if (is_none(is_hit)) return {is_hit};
        const Vector<Real> r = cross(ray.direction, s);
        const Real u = flip_sign(dot(r, f.edge_2), det);
        is_hit = both(is_hit, both(u >= zero, u <= size));
        if (is_none(is_hit)) return {is_hit};
        const Real v = flip_sign(dot(r, f.edge_1), det);
        return {both(is_hit, both(v >= zero, u + v <= size)), t, u, v, size};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
