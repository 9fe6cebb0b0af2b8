#include "study/exact_oracle.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>

namespace rtu::study {

namespace {

using Rational = boost::multiprecision::mpq_rational;

template <class T>
using Vector = std::array<T, 3>;

template <class T>
Vector<T> widen(model::Vec3 v) {
    return {T(double(v.x)), T(double(v.y)), T(double(v.z))};
}

template <class T>
Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
    return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

template <class T>
T triple(const Vector<T>& a, const Vector<T>& b, const Vector<T>& c) {
    return T(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]));
}

// Signed volumes that the ray's direction spans with the triangle's edges, all seen from the origin.
template <class T>
struct Volumes {
    Vector<T> a, b, c, d;
    T u, v, w;
};

template <class T>
Volumes<T> volumes(const model::TriangleMesh& mesh, const model::Triangle& triangle, const model::Ray& ray) {
    const auto origin = widen<T>(ray.origin);
    const auto seen = [&](std::uint32_t vertex) { return minus(widen<T>(mesh.positions[vertex]), origin); };
    Volumes<T> r;
    r.a = seen(triangle[0]);
    r.b = seen(triangle[1]);
    r.c = seen(triangle[2]);
    r.d = widen<T>(ray.direction);
    r.u = triple(r.d, r.c, r.b);
    r.v = triple(r.d, r.a, r.c);
    r.w = triple(r.d, r.b, r.a);
    return r;
}

double largest(const Vector<double>& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

// False only when binary64, with a generous bound on its error, is sure that the ray passes outside.
bool may_hit(const model::TriangleMesh& mesh, const model::Triangle& triangle, const model::Ray& ray) {
    const auto r = volumes<double>(mesh, triangle, ray);
    const double reach = std::max({largest(r.a), largest(r.b), largest(r.c)});
    const double bound = reach * reach * largest(r.d) * 1e-14;
    const bool has_positive = r.u > bound || r.v > bound || r.w > bound;
    const bool has_negative = r.u < -bound || r.v < -bound || r.w < -bound;
    return !(has_positive && has_negative);
}

struct ExactHit {
    Rational t;
    bool is_interior = false;
};

std::optional<ExactHit> intersect(const model::TriangleMesh& mesh, const model::Triangle& triangle,
                                  const model::Ray& ray) {
    const auto r = volumes<Rational>(mesh, triangle, ray);
    const bool has_positive = r.u > 0 || r.v > 0 || r.w > 0;
    const bool has_negative = r.u < 0 || r.v < 0 || r.w < 0;
    const Rational sum = r.u + r.v + r.w;
    if ((has_positive && has_negative) || sum == 0) return std::nullopt;
    // The point of weights u, v, w lies on the ray; any component of the direction gives its t.
    const std::size_t axis = r.d[0] != 0 ? 0 : r.d[1] != 0 ? 1 : 2;
    const Rational t = (r.u * r.a[axis] + r.v * r.b[axis] + r.w * r.c[axis]) / (sum * r.d[axis]);
    if (t <= Rational(double(ray.t_min))) return std::nullopt;
    if (std::isfinite(ray.t_max) && t >= Rational(double(ray.t_max))) return std::nullopt;
    return ExactHit{t, r.u != 0 && r.v != 0 && r.w != 0};
}

}  // namespace

bool ExactHits::allows_closest(std::optional<std::uint32_t> answer) const {
    if (!answer) return !has_interior_hit;
    return std::find(nearest.begin(), nearest.end(), *answer) != nearest.end();
}

bool ExactHits::allows_any(bool answer) const { return answer ? !nearest.empty() : !has_interior_hit; }

ExactHits exact_hits(const model::TriangleMesh& mesh, const model::Ray& ray) {
    ExactHits result;
    std::optional<Rational> least;
    for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
        if (!may_hit(mesh, mesh.triangles[id], ray)) continue;
        const auto hit = intersect(mesh, mesh.triangles[id], ray);
        if (!hit) continue;
        result.has_interior_hit |= hit->is_interior;
        if (!least || hit->t < *least) {
            least = hit->t;
            result.nearest.clear();
        }
        if (hit->t == *least) result.nearest.push_back(id);
    }
    return result;
}

}  // namespace rtu::study
