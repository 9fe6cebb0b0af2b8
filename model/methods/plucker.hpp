#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Pluecker's test seen from the ray's origin, where the ray has no moment: the volume of an edge with the
/// ray is direction . (p x q), and nothing is precomputed; [ERI97]. Accurate wherever the scene is, but the
/// cross product of nearly parallel vertices cancels: a triangle small for its distance has no inside.
///
/// Both neighbours see the same number at their common edge with opposite signs, so that nothing leaks there;
/// at a vertex it may. A pair has the common edge once and gives bit for bit what its triangles give.
struct Plucker : RayAsGiven, TwoDivisions {
    static constexpr MethodInfo info{
        .name = "plucker", .title = "Pluecker", .source = "[ERI97]", .stored_bytes = 36};
    static constexpr bool has_pair = true;

    template <class Real>
    struct Stored {
        Vector<Real> a, b, c;
    };
    template <class Real>
    struct PairStored {
        Vector<Real> a, b, c, d;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b, c};
    }

    template <class Real>
    [[nodiscard]] static PairStored<Real> store_pair(const Vector<Real>& a, const Vector<Real>& b,
                                                     const Vector<Real>& c, const Vector<Real>& d, Axis) {
        return {a, b, c, d};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        const Vector<Real>& along = ray.direction;
        const Vector<Real> a = f.a - ray.origin, b = f.b - ray.origin, c = f.c - ray.origin;
        const EdgeWeights<Real> weights{dot(along, cross(b, c)), dot(along, cross(c, a)),
                                        dot(along, cross(a, b))};
        const MaskOf<Real> is_in = is_on_one_side(weights);
        if (is_none(is_in)) return {is_in};
        return meet_plane(along, is_in, interval, a, b, c - a, weights);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair, AnyAxis) {
        const Vector<Real>& along = ray.direction;
        const Vector<Real> a = pair.a - ray.origin, b = pair.b - ray.origin;
        const Vector<Real> c = pair.c - ray.origin, d = pair.d - ray.origin;
        const Real common = dot(along, cross(c, a));
        const EdgeWeights<Real> first{dot(along, cross(b, c)), common, dot(along, cross(a, b))};
        const EdgeWeights<Real> second{dot(along, cross(c, d)), dot(along, cross(d, a)), -common};
        return meet_planes(along, interval, a, b, c, d, first, second);
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
