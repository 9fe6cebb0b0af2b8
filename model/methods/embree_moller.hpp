#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// What Embree calls Moller-Trumbore [Embree]: Kensler-Shirley's terms with the normal stored, and u and v
/// before t. Edges belong to both neighbours as far as rounding lets them: rays through edges and vertices
/// leak or hit twice.
struct EmbreeMoller : RayAsGiven, DeferredDivision {
    static constexpr MethodInfo info{.name = "embree_moller",
                                     .title = "Embree, Moller-Trumbore",
                                     .source = "[Embree] triangle_intersector_moeller.h",
                                     .stored_bytes = 48};
    template <class Real>
    struct Stored {
        Vector<Real> a, edge_1, edge_2, normal;  // b - a, a - c, their product
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        const Vector<Real> edge_1 = b - a, edge_2 = a - c;
        return {a, edge_1, edge_2, cross(edge_2, edge_1)};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Real zero(0.0F);
        const Vector<Real> s = f.a - ray.origin, r = cross(ray.direction, s);
        const Real det = dot(f.normal, ray.direction), size = magnitude(det);
        const Real u = flip_sign(dot(r, f.edge_2), det), v = flip_sign(dot(r, f.edge_1), det);
        const MaskOf<Real> is_in = both(both(u >= zero, v >= zero), u + v <= size);
        if (is_none(is_in)) return {is_in};
        const Real t = flip_sign(dot(f.normal, s), det);
        return {both(is_in, is_within(interval, t, size)), t, u, v, size};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
