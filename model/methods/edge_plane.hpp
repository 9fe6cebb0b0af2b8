#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The planes through the ray's origin and each edge: a ray that has all three on its negative side enters
/// the front of the triangle; [EP18], second listing. Edges and normal are stored. Triangles seen from behind
/// are not hit, as in the source, and neither is an edge: a ray through one may pass between its triangles. u
/// and v, which the source has not, are the shares of the edges' products.
struct EdgePlane : RayAsGiven, TwoDivisions {
    static constexpr MethodInfo info{.name = "edge_plane",
                                     .title = "edge planes",
                                     .source = "[EP18]",
                                     .stored_bytes = 84,
                                     .is_one_sided = true};
    template <class Real>
    struct Stored {
        Vector<Real> a, b, c, ab, bc, ca, normal;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b, c, b - a, c - b, a - c, cross(b - a, c - a)};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Real zero(0.0F);
        const Vector<Real> a = f.a - ray.origin;
        const Real of_c = dot(cross(a, f.ab), ray.direction);
        const Real of_a = dot(cross(f.b - ray.origin, f.bc), ray.direction);
        const Real of_b = dot(cross(f.c - ray.origin, f.ca), ray.direction);
        const MaskOf<Real> is_in = both(both(of_a < zero, of_b < zero), of_c < zero);
        if (is_none(is_in)) return {is_in};
        return meet_plane(is_in, interval, dot(f.normal, ray.direction), dot(f.normal, a),
                          {of_a, of_b, of_c});
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
