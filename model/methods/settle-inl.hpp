// The exact test for those lanes that a faster one could not decide.

#include <optional>

#include "model/methods/exact.hpp"
#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

template <class Real>
[[nodiscard]] float binary32(const Real& value) {
    return static_cast<float>(static_cast<double>(value));
}
template <class Real>
[[nodiscard]] Vec3 point_of(const Vector<Real>& v) {
    return {binary32(v[0]), binary32(v[1]), binary32(v[2])};
}

/// Replaces what `candidate` says where `is_decided` is not set.
template <class Real>
HWY_NOINLINE void settle_exactly(const Vector<Real>& origin, const Vector<Real>& direction,
                                 const Interval<Real>& interval, const Vector<Real>& a, const Vector<Real>& b,
                                 const Vector<Real>& c, bool is_decided, Candidate<Real>& candidate) {
    if (is_decided) return;
    const Ray ray{point_of(origin), binary32(interval.t_min), point_of(direction), binary32(interval.t_max)};
    const std::optional<TestHit> hit = test_exactly(ray, {point_of(a), point_of(b), point_of(c)});
    candidate = {hit.has_value()};
    if (hit) candidate = {true, Real(hit->t), Real(hit->u), Real(hit->v), Real(1.0F)};
}

/// The numbers of one lane; W of each.
template <std::size_t W>
class LaneValues {
  public:
    HWY_INLINE void append(const Vector<Lanes<W>>& v) {
        for (const Lanes<W>& component : v.c) append(component);
    }
    HWY_INLINE void append(Lanes<W> value) { value.store(values_[count_++]); }
    [[nodiscard]] float scalar(std::size_t index, std::size_t lane) const { return values_[index][lane]; }
    [[nodiscard]] Vector<float> vector(std::size_t index, std::size_t lane) const {
        return {{values_[index][lane], values_[index + 1][lane], values_[index + 2][lane]}};
    }

  private:
    HWY_ALIGN float values_[17][W];
    std::size_t count_ = 0;
};

template <std::size_t W>
HWY_NOINLINE void settle_exactly(const Vector<Lanes<W>>& origin, const Vector<Lanes<W>>& direction,
                                 const Interval<Lanes<W>>& interval, const Vector<Lanes<W>>& a,
                                 const Vector<Lanes<W>>& b, const Vector<Lanes<W>>& c, LaneMask<W> is_decided,
                                 Candidate<Lanes<W>>& candidate) {
    LaneValues<W> of;
    of.append(origin), of.append(direction), of.append(a), of.append(b), of.append(c);
    of.append(interval.t_min), of.append(interval.t_max);
    const Lanes<W> zero(0.0F), one(1.0F);
    HWY_ALIGN float decided[W], hit[W], t[W], u[W], v[W], det[W];
    select(is_decided, one, zero).store(decided);
    select(candidate.is_hit, one, zero).store(hit);
    candidate.t.store(t), candidate.u.store(u), candidate.v.store(v), candidate.det.store(det);
    for (std::size_t i = 0; i < W; ++i) {
        if (decided[i] > 0) continue;
        Candidate<float> single{false};
        settle_exactly(of.vector(0, i), of.vector(3, i), Interval<float>{of.scalar(15, i), of.scalar(16, i)},
                       of.vector(6, i), of.vector(9, i), of.vector(12, i), false, single);
        hit[i] = single.is_hit ? 1.0F : 0.0F;
        t[i] = single.t, u[i] = single.u, v[i] = single.v, det[i] = single.det;
    }
    candidate.is_hit = Lanes<W>::load(hit) > zero;
    candidate.t = Lanes<W>::load(t), candidate.u = Lanes<W>::load(u);
    candidate.v = Lanes<W>::load(v), candidate.det = Lanes<W>::load(det);
}

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
