#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Cramer's rule on origin - a = [-direction, b - a, c - a] (t, u, v), eq. 6 of the paper, divided as soon as
/// the determinant is known; without the paper's absolute epsilon, which is wrong at every scale but one.
/// A zero determinant divides to infinity or NaN and passes no test. Fails at edges and vertices: both
/// neighbours of an edge may miss, or both may hit.
struct MollerTrumbore : EarlyDivision {
    static constexpr MethodInfo info{
        .name = "moller_trumbore", .title = "Moller-Trumbore", .source = "[MT97] eq. 6", .stored_bytes = 36};
    template <class Real>
    struct RayData {
        Vector<Real> origin, direction;
    };
    template <class Real>
    struct Stored {
        Vector<Real> a, edge_1, edge_2;
    };

    template <class Real>
    [[nodiscard]] static RayData<Real> prepare(const Vector<Real>& origin, const Vector<Real>& direction,
                                               Axis) {
        return {origin, direction};
    }
    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b - a, c - a};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& triangle, AnyAxis) {
        const Real zero(0.0F), one(1.0F);
        const Vector<Real> p = cross(ray.direction, triangle.edge_2);
        const Real inverse = one / dot(triangle.edge_1, p);
        const Vector<Real> s = ray.origin - triangle.a;
        const Real u = dot(s, p) * inverse;
        MaskOf<Real> is_hit = both(u >= zero, u <= one);
        if (is_none(is_hit)) return {is_hit};
        const Vector<Real> q = cross(s, triangle.edge_1);
        const Real v = dot(ray.direction, q) * inverse;
        is_hit = both(is_hit, both(v >= zero, u + v <= one));
        if (is_none(is_hit)) return {is_hit};
        const Real t = dot(triangle.edge_2, q) * inverse;
        is_hit = both(is_hit, both(t > interval.t_min, t < interval.t_max));
        return {is_hit, t, u, v, one};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
