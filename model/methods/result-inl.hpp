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

/// Where is_hit is set, the ray hits the triangle; t, u and v are to be divided by det (EarlyDivision: they
/// are). Elsewhere the other members have no meaning.
template <class Real>
struct Candidate {
    MaskOf<Real> is_hit;
    Real t{0.0F}, u{0.0F}, v{0.0F}, det{0.0F};
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

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
