#include <type_traits>

#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Vertices seen from the ray's origin and sheared so that the ray runs along the axis of its largest
/// component, then three 2D edge functions [WBW13]. Here as published but for its binary64 fallback: an edge
/// belongs to both its triangles, so rays through edges and vertices hit twice; without contraction of
/// a * b - c * d nothing leaks.
struct Woop : DeferredDivision {
    static constexpr MethodInfo info{.name = "woop",
                                     .title = "Woop",
                                     .source = "[WBW13]",
                                     .stored_bytes = 36,
                                     .axis_owner = AxisOwner::Ray};
    static constexpr bool has_pair = true;

    template <class Real>
    struct RayData {
        Vector<Real> origin;
        Real shear_x, shear_y, scale_z;
    };
    template <class Real>
    struct Stored {
        Vector<Real> a, b, c;
    };
    template <class Real>
    struct PairStored {
        Vector<Real> a, b, c, d;
    };
    /// A vertex as the ray sees it.
    template <class Real>
    struct Sheared {
        Real x, y, z;
    };

    template <class Real>
    [[nodiscard]] static RayData<Real> prepare(const Vector<Real>& origin, const Vector<Real>& direction,
                                               Axis axis) {
        const Real d = pick<0>(axis, direction);
        return {origin, pick<1>(axis, direction) / d, pick<2>(axis, direction) / d, Real(1.0F) / d};
    }
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
    [[nodiscard]] static HWY_INLINE Sheared<Real> shear(const RayData<Real>& ray, const Vector<Real>& vertex,
                                                        AnyAxis axis) {
        const Real z = pick<0>(axis, vertex) - pick<0>(axis, ray.origin);
        return {(pick<1>(axis, vertex) - pick<1>(axis, ray.origin)) - ray.shear_x * z,
                (pick<2>(axis, vertex) - pick<2>(axis, ray.origin)) - ray.shear_y * z, z};
    }
    template <class Real>
    [[nodiscard]] static HWY_INLINE Real edge_function(const Sheared<Real>& p, const Sheared<Real>& q) {
        return p.x * q.y - p.y * q.x;
    }

    /// Edge functions; u, v, w are the weights of a triangle's second, third and first corner.
    template <class Real>
    struct Weights {
        Real u, v, w;
        [[nodiscard]] HWY_INLINE MaskOf<Real> agree() const {
            const Real zero(0.0F);
            return either(smaller(smaller(u, v), w) >= zero, larger(larger(u, v), w) <= zero);
        }
    };

    /// The corners are in the order of the weights w, u, v.
    template <class Real>
    [[nodiscard]] static HWY_INLINE Candidate<Real> at_depth(const RayData<Real>& ray,
                                                             const Interval<Real>& interval,
                                                             MaskOf<Real> is_in, const Weights<Real>& by,
                                                             const Sheared<Real>& p, const Sheared<Real>& q,
                                                             const Sheared<Real>& r) {
        if constexpr (std::is_same_v<MaskOf<Real>, bool>)  // one depth for a pair, unless it is folded
            if (!is_in) return {is_in};
        const Real det = by.w + by.u + by.v;
        const Real t = (by.w * p.z + by.u * q.z + by.v * r.z) * ray.scale_z;
        const Real size = magnitude(det), distance = flip_sign(t, det);
        const auto is_hit = both(is_in, is_within(interval, distance, size));
        return {is_hit, t, by.u, by.v, det};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& triangle, AnyAxis axis) {
        const Sheared<Real> a = shear(ray, triangle.a, axis);
        const Sheared<Real> b = shear(ray, triangle.b, axis);
        const Sheared<Real> c = shear(ray, triangle.c, axis);
        const Weights<Real> by{edge_function(c, a), edge_function(a, b), edge_function(b, c)};
        const auto is_in = by.agree();
        if (is_none(is_in)) return {is_in};
        return at_depth(ray, interval, is_in, by, a, b, c);
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PairCandidate<Real> test_pair(const RayData<Real>& ray,
                                                                  const Interval<Real>& interval,
                                                                  const PairStored<Real>& pair,
                                                                  AnyAxis axis) {
        const Sheared<Real> a = shear(ray, pair.a, axis);
        const Sheared<Real> b = shear(ray, pair.b, axis);
        const Sheared<Real> c = shear(ray, pair.c, axis);
        const Sheared<Real> d = shear(ray, pair.d, axis);
        const Real common = edge_function(c, a);
        const Weights<Real> first{common, edge_function(a, b), edge_function(b, c)};
        const Weights<Real> second{edge_function(d, a), -common, edge_function(c, d)};
        const auto is_in_first = first.agree(), is_in_second = second.agree();
        if (is_none(either(is_in_first, is_in_second))) return {{is_in_first}, {is_in_second}};
        return {at_depth(ray, interval, is_in_first, first, a, b, c),
                at_depth(ray, interval, is_in_second, second, a, c, d)};
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
