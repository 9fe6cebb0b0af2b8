#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Pluecker's test seen from the ray's origin, by two cross products of the direction with a and c rather
/// than three of the vertices; [ERI97], rearranged. An outer edge is anchored differently in its two
/// triangles, so that rays leak there; else as `plucker`.
///
/// The two cross products belong to the corners that a pair shares. The second triangle is tested as
/// (a, d, c): the pair gives bit for bit what (a, b, c) and (a, d, c) give alone, u and v of the latter
/// swapped; what (a, c, d) gives alone differs by rounding.
struct PluckerTwoCross : RayAsGiven, TwoDivisions {
    static constexpr MethodInfo info{.name = "plucker_two_cross",
                                     .title = "Pluecker, two cross products",
                                     .source = "[ERI97]",
                                     .stored_bytes = 36,
                                     .is_pair_reversed = true};
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
        const Vector<Real> a = f.a - ray.origin, b = f.b - ray.origin, c = f.c - ray.origin;
        const Vector<Real> x = cross(a, ray.direction), y = cross(c, ray.direction);
        const EdgeWeights<Real> weights{dot(b, y), dot(c, x), -dot(b, x)};
        const MaskOf<Real> is_in = is_on_one_side(weights);
        if (is_none(is_in)) return {is_in};
        return meet_plane(ray.direction, is_in, interval, a, b, c - a, weights);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair, AnyAxis) {
        const Vector<Real> a = pair.a - ray.origin, b = pair.b - ray.origin;
        const Vector<Real> c = pair.c - ray.origin, d = pair.d - ray.origin;
        const Vector<Real> x = cross(a, ray.direction), y = cross(c, ray.direction);
        const Real common = dot(c, x);
        const EdgeWeights<Real> first{dot(b, y), common, -dot(b, x)};
        const EdgeWeights<Real> swapped{dot(d, y), common, -dot(d, x)};
        const auto [abc, adc] = meet_planes(ray.direction, interval, a, b, c, d, first, swapped);
        return {abc, {adc.is_hit, adc.t, adc.v, adc.u, adc.det, adc.weight_sum}};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
