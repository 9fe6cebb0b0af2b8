#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Wald's weights without projection, as two planes through the edges at a beside the triangle's own, and the
/// division deferred; [HH11] eq. 11 to 13. Signs are compared inclusively rather than by their bits (eq. 10),
/// so that -0 counts as 0.
/// The planes are seen from the world's origin: far from it all accuracy is lost. Slivers are mostly missed,
/// and edges belong to both neighbours or to neither.
struct HavelHerout : RayAsGiven, DeferredDivision {
    static constexpr MethodInfo info{
        .name = "havel_herout", .title = "Havel-Herout", .source = "[HH11] eq. 11-13", .stored_bytes = 48};
    /// Plane: n . x = d; weights of a point of it: u = n_1 . x + d_1, v = n_2 . x + d_2.
    template <class Real>
    struct Stored {
        Vector<Real> n;
        Real d;
        Vector<Real> n_1;
        Real d_1;
        Vector<Real> n_2;
        Real d_2;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        const Vector<Real> ab = b - a, ac = c - a, n = cross(ab, ac);
        const Real inverse = Real(1.0F) / dot(n, n);
        const Vector<Real> n_1 = cross(ac, n) * inverse, n_2 = cross(n, ab) * inverse;
        return {n, dot(n, a), n_1, -dot(n_1, a), n_2, -dot(n_2, a)};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Real zero(0.0F);
        const Real det = dot(f.n, ray.direction), size = magnitude(det);
        const Real t_det = f.d - dot(f.n, ray.origin), t = flip_sign(t_det, det);
        MaskOf<Real> is_hit = is_within(interval, t, size);
        if (is_none(is_hit)) return {is_hit};
        const Vector<Real> point = ray.origin * det + ray.direction * t_det;
        const Real u = flip_sign(dot(point, f.n_1) + det * f.d_1, det);
        is_hit = both(is_hit, both(u >= zero, u <= size));
        if (is_none(is_hit)) return {is_hit};
        const Real v = flip_sign(dot(point, f.n_2) + det * f.d_2, det);
        return {both(is_hit, both(v >= zero, u + v <= size)), t, u, v, size};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
