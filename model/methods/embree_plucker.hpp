#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// What Embree's robust mode does [Embree]: Pluecker's test seen from the ray's origin with an edge as
/// (q - p) x (p + q), which does not cancel where vertices are nearly parallel, a tolerance of one unit of
/// the sum of the three volumes, and the normal from the better two edges in each component. The tolerance
/// closes edges, which are then hit twice, but not all vertices.
struct EmbreePlucker : RayAsGiven, TwoDivisions {
    static constexpr MethodInfo info{.name = "embree_plucker",
                                     .title = "Embree, Pluecker",
                                     .source = "[Embree] triangle_intersector_pluecker.h",
                                     .stored_bytes = 36};
    template <class Real>
    struct Stored {
        Vector<Real> a, b, c;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b, c};
    }

    /// x y - z w, and z w.
    template <class Real>
    struct Difference {
        Real value, subtrahend;
    };
    template <class Real>
    [[nodiscard]] static HWY_INLINE Difference<Real> difference(const Real& x, const Real& y, const Real& z,
                                                                const Real& w) {
        const Real subtrahend = z * w;
        return {x * y - subtrahend, subtrahend};
    }
    /// One component of the normal, from a x b or b x c: what subtracts less.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real component(int i, const Vector<Real>& a, const Vector<Real>& b,
                                                   const Vector<Real>& c) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Difference<Real> ab = difference(a[j], b[k], a[k], b[j]);
        const Difference<Real> bc = difference(b[j], c[k], b[k], c[j]);
        return select(magnitude(ab.subtrahend) < magnitude(bc.subtrahend), ab.value, bc.value);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Vector<Real> a = f.a - ray.origin, b = f.b - ray.origin, c = f.c - ray.origin;
        const Vector<Real> ac = c - a, ba = a - b, cb = b - c;
        const Real of_b = dot(cross(ac, c + a), ray.direction);
        const Real of_c = dot(cross(ba, a + b), ray.direction);
        const Real of_a = dot(cross(cb, b + c), ray.direction);
        const Real sum = of_b + of_c + of_a, tolerance = magnitude(sum) * Real(0x1p-23F);
        const Real below = -tolerance;
        const MaskOf<Real> is_in =
            either(both(both(of_a >= below, of_b >= below), of_c >= below),
                   both(both(of_a <= tolerance, of_b <= tolerance), of_c <= tolerance));
        if (is_none(is_in)) return {is_in};
        const Vector<Real> normal{
            {component(0, ac, ba, cb), component(1, ac, ba, cb), component(2, ac, ba, cb)}};
        const Real det = dot(normal, ray.direction);
        const Real size = magnitude(det), distance = flip_sign(dot(normal, a), det);
        return {both(is_in, is_within(interval, distance, size)), distance, of_b, of_c, size, sum};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
