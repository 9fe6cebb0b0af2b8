#include <type_traits>

#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Ours: the decisions of the exact test at nearly Woop's speed. Binary32 decides where edge functions and t
/// lie beyond the bounds on their rounding errors (docs/methods.md); the rest, rare unless rays graze edges
/// or triangles are tiny for their distance, goes to the exact test. So a ray is hit or not as on the numbers
/// that were given, whatever W and whatever the compiler contracts; t, u and v are those of Woop's method, or
/// of the exact test where that decided. A pair gives bit for bit what its triangles give.
struct WoopExact : Woop {
    static constexpr MethodInfo info{.name = "woop_exact",
                                     .title = "rtusim, exact decision",
                                     .source = "docs/methods.md, after [WBW13]",
                                     .stored_bytes = 40,
                                     .axis_owner = AxisOwner::Ray};

    /// `extent` is the largest coordinate by magnitude, of the ray's origin or of all corners.
    template <class Real>
    struct RayData {
        Woop::RayData<Real> sheared;
        Vector<Real> direction;
        Real extent;
    };
    template <class Real>
    struct Stored {
        Vector<Real> a, b, c;
        Real extent;
    };
    template <class Real>
    struct PairStored {
        Vector<Real> a, b, c, d;
        Real extent_first, extent_second;
    };

    template <class Real>
    [[nodiscard]] static RayData<Real> prepare(const Vector<Real>& origin, const Vector<Real>& direction,
                                               Axis axis) {
        return {Woop::prepare(origin, direction, axis), direction, extent(origin)};
    }
    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {a, b, c, larger(larger(extent(a), extent(c)), extent(b))};
    }
    template <class Real>
    [[nodiscard]] static PairStored<Real> store_pair(const Vector<Real>& a, const Vector<Real>& b,
                                                     const Vector<Real>& c, const Vector<Real>& d, Axis) {
        const Real shared = larger(extent(a), extent(c));
        return {a, b, c, d, larger(shared, extent(b)), larger(shared, extent(d))};
    }
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real extent(const Vector<Real>& v) {
        return larger(larger(magnitude(v[0]), magnitude(v[1])), magnitude(v[2]));
    }

    /// How far corners lie from the ray's origin: largest |x| + |y|, largest |z|.
    template <class Real>
    struct Reach {
        Real across, along;
    };
    template <class Real>
    [[nodiscard]] static HWY_INLINE Reach<Real> reach(const Sheared<Real>& p) {
        return {magnitude(p.x) + magnitude(p.y), magnitude(p.z)};
    }
    template <class Real>
    [[nodiscard]] static HWY_INLINE Reach<Real> farther(const Reach<Real>& a, const Reach<Real>& b) {
        return {larger(a.across, b.across), larger(a.along, b.along)};
    }

    /// What binary32 is sure of; neither: it cannot tell.
    template <class Real>
    struct Verdict {
        MaskOf<Real> is_missed, is_passed;
    };
    /// Bound on an edge function's error, from how far the corners are seen to lie.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real edge_error(const Reach<Real>& reach) {
        const Real scale(0x1p-20F);
        return scale * (reach.across + scale * reach.along) * (reach.across + reach.along) + Real(0x1p-126F);
    }
    /// The same from how far they can lie at most: |x| + |y| <= 4 r, |z| <= r with r the sum of extents.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real edge_error(const Real& farthest) {
        return Real(0x1p-15F) * farthest * farthest + Real(0x1p-126F);
    }
    template <class Real>
    [[nodiscard]] static HWY_INLINE Verdict<Real> judge(const Weights<Real>& by, const Real& error) {
        const Real low = smaller(smaller(by.u, by.v), by.w), high = larger(larger(by.u, by.v), by.w);
        const auto is_bounded = error < Real(0x1p100F);  // else products may have overflowed
        return {both(smaller(high, -low) > error, is_bounded), both(larger(low, -high) > error, is_bounded)};
    }

    /// The depth of a triangle whose edges the ray passes on one side, and what is sure of it. With an edge
    /// function's error B: det errs by 4 B at most, t det by 5 B (|z| / |d| + |t|), and what is compared
    /// by 6.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Verdict<Real> judge_depth(const Candidate<Real>& c,
                                                              const Interval<Real>& interval,
                                                              const Real& error, const Real& depth_error) {
        const Real size = magnitude(c.det), distance = flip_sign(c.t, c.det);
        const Real least = size - error, most = size + error;
        const auto is_after =
            distance > interval.t_min * size + (depth_error + magnitude(interval.t_min) * error);
        const auto is_before = distance < interval.t_max * least - depth_error;
        const auto is_behind =
            distance < interval.t_min * size - (depth_error + magnitude(interval.t_min) * error);
        const auto is_beyond = distance > interval.t_max * most + depth_error;
        return {either(is_behind, is_beyond), both(is_after, is_before)};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& triangle, AnyAxis axis) {
        const Sheared<Real> a = shear(ray.sheared, triangle.a, axis);
        const Sheared<Real> b = shear(ray.sheared, triangle.b, axis);
        const Sheared<Real> c = shear(ray.sheared, triangle.c, axis);
        const Weights<Real> by{edge_function(c, a), edge_function(a, b), edge_function(b, c)};
        return decide(ray, interval, ray.extent + triangle.extent, axis, by, a.z, b.z, c.z, triangle.a,
                      triangle.b, triangle.c);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair,
                                                                  AnyAxis axis) {
        const Sheared<Real> a = shear(ray.sheared, pair.a, axis);
        const Sheared<Real> b = shear(ray.sheared, pair.b, axis);
        const Sheared<Real> c = shear(ray.sheared, pair.c, axis);
        const Sheared<Real> d = shear(ray.sheared, pair.d, axis);
        const Real common = edge_function(c, a);
        const Weights<Real> first{common, edge_function(a, b), edge_function(b, c)};
        const Weights<Real> second{edge_function(d, a), -common, edge_function(c, d)};
        return {decide(ray, interval, ray.extent + pair.extent_first, axis, first, a.z, b.z, c.z, pair.a,
                       pair.b, pair.c),
                decide(ray, interval, ray.extent + pair.extent_second, axis, second, a.z, c.z, d.z, pair.a,
                       pair.c, pair.d)};
    }

  private:
    template <class Real>
    struct Answer {
        Candidate<Real> candidate;
        MaskOf<Real> is_decided;
    };

    template <class Real>
    [[nodiscard]] static HWY_INLINE Answer<Real> answer(
        const RayData<Real>& ray, const Interval<Real>& interval, const Weights<Real>& by, const Real& z_a,
        const Real& z_b, const Real& z_c, const Verdict<Real>& edges, const Real& error, const Real& along) {
        Candidate<Real> found{edges.is_passed};
        found.det = by.w + by.u + by.v;
        found.t = (by.w * z_a + by.u * z_b + by.v * z_c) * ray.sheared.scale_z;
        found.u = by.u;
        found.v = by.v;
        const Real six_errors = Real(6.0F) * error;
        const Real depth_error = six_errors * (along * magnitude(ray.sheared.scale_z)) + Real(0x1p-126F);
        const Verdict<Real> depth = judge_depth(found, interval, six_errors, depth_error);
        found.is_hit = both(edges.is_passed, depth.is_passed);
        const auto is_missed = either(edges.is_missed, both(edges.is_passed, depth.is_missed));
        return {found, either(found.is_hit, is_missed)};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> decide(
        const RayData<Real>& ray, const Interval<Real>& interval, const Real& farthest, AnyAxis axis,
        const Weights<Real>& by, const Real& z_a, const Real& z_b, const Real& z_c, const Vector<Real>& a,
        const Vector<Real>& b, const Vector<Real>& c) {
        const Real error = edge_error(farthest);
        const Verdict<Real> edges = judge(by, error);
        if (is_all(edges.is_missed)) return {inverted(edges.is_missed)};
        const Answer<Real> first = answer(ray, interval, by, z_a, z_b, z_c, edges, error, farthest);
        if (is_all(first.is_decided)) return first.candidate;
        return look_closer<Real>(ray, interval, axis, a, b, c);
    }

    // What is passed by value stays in registers until the call, which is rare: scalar code is twice as fast.
    template <class Real, class T>
    using Passed = std::conditional_t<std::is_same_v<Real, float>, T, const T&>;

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_NOINLINE Candidate<Real> look_closer(Passed<Real, RayData<Real>> ray,
                                                                  Passed<Real, Interval<Real>> interval,
                                                                  AnyAxis axis, Passed<Real, Vector<Real>> a,
                                                                  Passed<Real, Vector<Real>> b,
                                                                  Passed<Real, Vector<Real>> c) {
        const Sheared<Real> p = shear(ray.sheared, a, axis), q = shear(ray.sheared, b, axis),
                            r = shear(ray.sheared, c, axis);
        const Weights<Real> by{edge_function(r, p), edge_function(p, q), edge_function(q, r)};
        const Reach<Real> seen = farther(farther(reach(p), reach(q)), reach(r));
        const Real error = edge_error(seen);
        Answer<Real> second = answer(ray, interval, by, p.z, q.z, r.z, judge(by, error), error, seen.along);
        if (!is_all(second.is_decided))
            settle_exactly(ray.sheared.origin, ray.direction, interval, a, b, c, second.is_decided,
                           second.candidate);
        return second.candidate;
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
