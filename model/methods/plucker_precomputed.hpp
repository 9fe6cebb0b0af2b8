#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// The sides on which the ray passes the edges as inner products of Pluecker coordinates, all of the
/// triangle's precomputed, and t from its plane; [ERI97], [SSK07] section 3. The moments are taken about the
/// world's origin: at 1e3 from it with unit triangles one test in four is wrong, farther none is right.
///
/// A pair keeps the common edge once and gives bit for bit what its triangles give.
struct PluckerPrecomputed : TwoDivisions {
    static constexpr MethodInfo info{.name = "plucker_precomputed",
                                     .title = "Pluecker, precomputed",
                                     .source = "[ERI97], [SSK07] section 3",
                                     .stored_bytes = 88};
    static constexpr bool has_pair = true;

    template <class Real>
    struct RayData {
        Vector<Real> origin, direction, moment;
    };
    template <class Real>
    struct Edge {
        Vector<Real> direction, moment;
    };
    /// Plane: n . x = d.
    template <class Real>
    struct Plane {
        Vector<Real> n;
        Real d;
    };
    template <class Real>
    struct Stored {
        Edge<Real> bc, ca, ab;
        Plane<Real> plane;
    };
    template <class Real>
    struct PairStored {
        Edge<Real> bc, ca, ab, cd, da;
        Plane<Real> first, second;
    };

    template <class Real>
    [[nodiscard]] static RayData<Real> prepare(const Vector<Real>& origin, const Vector<Real>& direction,
                                               Axis) {
        return {origin, direction, cross(origin, direction)};
    }
    template <class Real>
    [[nodiscard]] static Edge<Real> edge(const Vector<Real>& from, const Vector<Real>& to) {
        return {to - from, cross(from, to)};
    }
    template <class Real>
    [[nodiscard]] static Plane<Real> plane(const Vector<Real>& a, const Vector<Real>& b,
                                           const Vector<Real>& c) {
        const Vector<Real> n = cross(b - a, c - a);
        return {n, dot(n, a)};
    }
    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis) {
        return {edge(b, c), edge(c, a), edge(a, b), plane(a, b, c)};
    }

    template <class Real>
    [[nodiscard]] static PairStored<Real> store_pair(const Vector<Real>& a, const Vector<Real>& b,
                                                     const Vector<Real>& c, const Vector<Real>& d, Axis) {
        return {edge(b, c), edge(c, a), edge(a, b), edge(c, d), edge(d, a), plane(a, b, c), plane(a, c, d)};
    }

    /// Six times the signed volume of the edge's ends with the ray's direction, seen from its origin.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real side(const RayData<Real>& ray, const Edge<Real>& edge) {
        return dot(ray.direction, edge.moment) + dot(ray.moment, edge.direction);
    }
    template <class Real>
    [[nodiscard]] static HWY_INLINE Candidate<Real> decide(const RayData<Real>& ray,
                                                           const Interval<Real>& interval,
                                                           const Plane<Real>& plane, const Real& of_a,
                                                           const Real& of_b, const Real& of_c) {
        const MaskOf<Real> is_in = is_on_one_side(EdgeWeights<Real>{of_a, of_b, of_c});
        if (is_none(is_in)) return {is_in};
        return meet_plane(is_in, interval, dot(plane.n, ray.direction), plane.d - dot(plane.n, ray.origin),
                          {of_a, of_b, of_c});
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis) {
        return decide(ray, interval, f.plane, side(ray, f.bc), side(ray, f.ca), side(ray, f.ab));
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair, AnyAxis) {
        const Real common = side(ray, pair.ca);
        return {decide(ray, interval, pair.first, side(ray, pair.bc), common, side(ray, pair.ab)),
                decide(ray, interval, pair.second, side(ray, pair.cd), side(ray, pair.da), -common)};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
