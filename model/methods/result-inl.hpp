// What every method takes and gives. A method is a struct with
//   static constexpr MethodInfo info;
//   template <class Real> struct RayData;                 what it keeps of a ray, Reals only
//   template <class Real> struct Stored;                  what it keeps of a triangle, Reals only
//   prepare(origin, direction, Axis) -> RayData<Real>     once a ray
//   store(a, b, c, Axis) -> Stored<Real>                  once a triangle: its precomputation
//   test(RayData, Interval, Stored, axis) -> Candidate    decides
//   finish(Candidate) -> Distances                        the hit's t, u, v: what division is deferred to
// `axis` is that of MethodInfo::axis_owner. With has_pair also PairStored, store_pair() and test_pair(), for
// triangles (a, b, c) and (a, c, d).

#include "model/methods/method.hpp"
#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The open interval in which t counts.
template <class Real>
struct Interval {
    Real t_min, t_max;
};

/// Whether t lies in the interval.
template <class Real>
[[nodiscard]] HWY_INLINE MaskOf<Real> is_within(const Interval<Real>& interval, const Real& t) {
    return both(t > interval.t_min, t < interval.t_max);
}
/// Whether distance / size does, without dividing; `size` is not negative, and at 0 nothing is within.
template <class Real>
[[nodiscard]] HWY_INLINE MaskOf<Real> is_within(const Interval<Real>& interval, const Real& distance,
                                                const Real& size) {
    return both(distance > interval.t_min * size, distance < interval.t_max * size);
}

/// Where is_hit is set, the ray hits the triangle; t, u and v are to be divided by det (EarlyDivision: they
/// are; TwoDivisions: u and v by weight_sum). Elsewhere the other members have no meaning.
template <class Real>
struct Candidate {
    MaskOf<Real> is_hit;
    Real t{0.0F}, u{0.0F}, v{0.0F}, det{0.0F}, weight_sum{0.0F};
};

template <class Real>
struct PairCandidate {
    Candidate<Real> first, second;
};

template <class Real>
struct Distances {
    Real t, u, v;
};

struct DeferredDivision {
    template <class Real>
    [[nodiscard]] static HWY_INLINE Distances<Real> finish(const Candidate<Real>& c) {
        const Real inverse = Real(1.0F) / c.det;
        return {c.t * inverse, c.u * inverse, c.v * inverse};
    }
};

struct EarlyDivision {
    template <class Real>
    [[nodiscard]] static HWY_INLINE Distances<Real> finish(const Candidate<Real>& c) {
        return {c.t, c.u, c.v};
    }
};

/// Where the plane gives t and the edges give u and v.
struct TwoDivisions {
    template <class Real>
    [[nodiscard]] static HWY_INLINE Distances<Real> finish(const Candidate<Real>& c) {
        const Real inverse = Real(1.0F) / c.weight_sum;
        return {c.t / c.det, c.u * inverse, c.v * inverse};
    }
};

/// A method that keeps nothing of a ray but the ray.
struct RayAsGiven {
    template <class Real>
    struct RayData {
        Vector<Real> origin, direction;
    };
    template <class Real>
    [[nodiscard]] static RayData<Real> prepare(const Vector<Real>& origin, const Vector<Real>& direction,
                                               Axis) {
        return {origin, direction};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
