#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Wald's projection with the division deferred, derived from the Pluecker test: [SSK07] section 4, eq. 8 to
/// 10 of [HH11]. All is scaled by the normal's largest component, so that a triangle orthogonal to an axis
/// has a normal of that axis alone and takes a shorter path, whose results are the same. The paper tests the
/// aperture (u and v) before the distance, because in a spatial subdivision the former rejects more; with
/// DistanceFirst it is the other way round, as in [HH11].
/// The plane is seen from the world's origin: far from it all accuracy is lost. Edges belong to both
/// neighbours as far as rounding lets them.
template <bool DistanceFirst>
struct ShevtsovOrder : RayAsGiven, DeferredDivision {
    static constexpr MethodInfo info{
        .name = DistanceFirst ? "shevtsov_distance_first" : "shevtsov",
        .title = DistanceFirst ? "Shevtsov, distance first" : "Shevtsov",
        .source = DistanceFirst ? "[SSK07], [HH11] eq. 8-10" : "[SSK07] section 4",
        .stored_bytes = 36,
        .axis_owner = AxisOwner::Triangle};
    /// Plane: x[k] + n_p x[p] + n_q x[q] = d, with p and q the axes after k; the edges over the normal's k.
    template <class Real>
    struct Stored {
        Real n_p, n_q, d;
        Real a_p, a_q;
        Real edge_1_p, edge_1_q, edge_2_p, edge_2_q;
    };
    /// The plane's part of the test: its det and t times that.
    template <class Real>
    struct PlaneTest {
        Real det, t_det;
    };

    template <class Real>
    [[nodiscard]] static Stored<Real> store(const Vector<Real>& a, const Vector<Real>& b,
                                            const Vector<Real>& c, Axis axis) {
        const Vector<Real> edge_1 = b - a, edge_2 = c - a, n = cross(edge_1, edge_2);
        const Real inverse = Real(1.0F) / pick<0>(axis, n);
        const Real n_p = pick<1>(axis, n) * inverse, n_q = pick<2>(axis, n) * inverse;
        const Real a_p = pick<1>(axis, a), a_q = pick<2>(axis, a);
        return {n_p,
                n_q,
                pick<0>(axis, a) + n_p * a_p + n_q * a_q,
                a_p,
                a_q,
                pick<1>(axis, edge_1) * inverse,
                pick<2>(axis, edge_1) * inverse,
                pick<1>(axis, edge_2) * inverse,
                pick<2>(axis, edge_2) * inverse};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE PlaneTest<Real> test_plane(const RayData<Real>& ray,
                                                               const Stored<Real>& f, AnyAxis axis) {
        const Real zero(0.0F);
        const Real d_k = pick<0>(axis, ray.direction), o_k = pick<0>(axis, ray.origin);
        if (is_none(either(f.n_p<zero, f.n_p> zero)) && is_none(either(f.n_q<zero, f.n_q> zero)))
            return {d_k, f.d - o_k};
        return {d_k + f.n_p * pick<1>(axis, ray.direction) + f.n_q * pick<2>(axis, ray.direction),
                f.d - o_k - f.n_p * pick<1>(axis, ray.origin) - f.n_q * pick<2>(axis, ray.origin)};
    }

    /// Whether u and v are in; without regard to t.
    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test_aperture(const RayData<Real>& ray,
                                                                  const Stored<Real>& f,
                                                                  const PlaneTest<Real>& plane,
                                                                  AnyAxis axis) {
        const Real zero(0.0F), size = magnitude(plane.det);
        const Real p =
            plane.t_det * pick<1>(axis, ray.direction) - plane.det * (f.a_p - pick<1>(axis, ray.origin));
        const Real q =
            plane.t_det * pick<2>(axis, ray.direction) - plane.det * (f.a_q - pick<2>(axis, ray.origin));
        const Real u = flip_sign(f.edge_2_q * p - f.edge_2_p * q, plane.det);
        const MaskOf<Real> is_in = both(u >= zero, u <= size);
        if (is_none(is_in)) return {is_in};
        const Real v = flip_sign(f.edge_1_p * q - f.edge_1_q * p, plane.det);
        return {both(is_in, both(v >= zero, u + v <= size)), flip_sign(plane.t_det, plane.det), u, v, size};
    }

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& f, AnyAxis axis) {
        const PlaneTest<Real> plane = test_plane(ray, f, axis);
        if constexpr (DistanceFirst) {
            const Real distance = flip_sign(plane.t_det, plane.det);
            const MaskOf<Real> is_near = is_within(interval, distance, magnitude(plane.det));
            if (is_none(is_near)) return {is_near};
            Candidate<Real> candidate = test_aperture(ray, f, plane, axis);
            candidate.is_hit = both(is_near, candidate.is_hit);
            return candidate;
        } else {
            Candidate<Real> candidate = test_aperture(ray, f, plane, axis);
            if (is_none(candidate.is_hit)) return candidate;
            candidate.is_hit = both(candidate.is_hit, is_within(interval, candidate.t, candidate.det));
            return candidate;
        }
    }
};

using Shevtsov = ShevtsovOrder<false>;
using ShevtsovDistanceFirst = ShevtsovOrder<true>;

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
