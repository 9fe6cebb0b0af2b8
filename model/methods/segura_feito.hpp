#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The signs of three signed volumes of the ray with the edges, one after the other as far as needed: the two
/// edges at a first, which have a cross product in common; [SF01]. Then t from the plane. Fails as
/// `plucker_two_cross` does: it misses nearly all triangles that are small for their distance, and leaks at
/// edges.
struct SeguraFeito : RayAsGiven, TwoDivisions {
    static constexpr MethodInfo info{
        .name = "segura_feito", .title = "Segura-Feito", .source = "[SF01]", .stored_bytes = 36};

    template <class Real>
    struct Stored {
        Vector<Real> a, b, c;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b, c};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Real zero(0.0F);
        const Vector<Real> a = f.a - ray.origin, b = f.b - ray.origin, c = f.c - ray.origin;
        const Vector<Real> x = cross(a, ray.direction);
        const Real of_b = dot(c, x), of_c = -dot(b, x);
        const MaskOf<Real> is_wedge =
            either(both(of_b >= zero, of_c >= zero), both(of_b <= zero, of_c <= zero));
        if (is_none(is_wedge)) return {is_wedge};
        const Real of_a = dot(b, cross(c, ray.direction));
        const MaskOf<Real> is_in = is_on_one_side(EdgeWeights<Real>{of_a, of_b, of_c});
        if (is_none(is_in)) return {is_in};
        return meet_plane(ray.direction, is_in, interval, a, b, c - a, {of_a, of_b, of_c});
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
