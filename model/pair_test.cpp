#include "model/pair_test.hpp"

#include <algorithm>
#include <cmath>

#include "model/difference_of_products.hpp"

namespace rtu::model {

namespace {

// A vertex relative to the ray: the ray runs through (0, 0) along z.
struct Sheared {
    float x, y, z;
};

// On which side of an edge the ray runs. Neither, when the edge's ends coincide in the sheared plane.
enum class Side : std::int8_t { Negative = -1, Neither = 0, Positive = 1 };

Side opposite(Side side) { return Side(-int(side)); }

Sheared shear(Vec3 vertex, const RaySetup& ray) {
    const Vec3 a = vertex - ray.origin;
    const float z = a[ray.kz];
    return {a[ray.kx] - ray.shear_x * z, a[ray.ky] - ray.shear_y * z, z};
}

Side side_of(bool is_positive) { return is_positive ? Side::Positive : Side::Negative; }

// The side of an edge that the ray meets exactly: that of the ray moved by (e, e^2). Reversing the edge
// reverses the answer, so the two triangles at an edge never agree.
Side resolve_tie(Sheared p, Sheared q) {
    if (p.y != q.y) return side_of(p.y > q.y);
    if (p.x != q.x) return side_of(q.x > p.x);
    return Side::Neither;
}

// The sign of px * qy - py * qx, exact. Rounding is monotone, so a non-zero binary32 difference of the
// rounded products has it; a zero or a NaN (overflow) is decided by binary64, whose products of binary32
// numbers are exact.
Side edge_side(Sheared p, Sheared q) {
    const float value = p.x * q.y - p.y * q.x;
    if (value > 0.0F || value < 0.0F) return side_of(value > 0.0F);
    const double exact = double(p.x) * double(q.y) - double(p.y) * double(q.x);
    if (exact > 0.0 || exact < 0.0) return side_of(exact > 0.0);
    return resolve_tie(p, q);
}

// The edge function itself, for a triangle that is pierced: rounded once, so that a needle's depth and
// barycentrics keep their digits.
float edge_function(Sheared p, Sheared q) { return difference_of_products(p.x, q.y, p.y, q.x); }

struct Corners {
    Sheared a, b, c;
};

// Sides of the edges opposite to the stored corners 0, 1, 2.
struct Sides {
    Side u, v, w;
    [[nodiscard]] bool is_inside() const { return u == v && v == w && u != Side::Neither; }
};

bool intersect(const Corners& corners, const Sides& sides, const RaySetup& ray, float t_near,
               CornerOrder order, Hit& hit) {
    if (!sides.is_inside()) return false;
    const auto& [a, b, c] = corners;
    const std::array<float, 3> weights{edge_function(c, b), edge_function(a, c), edge_function(b, a)};
    const float area = weights[0] + weights[1] + weights[2];
    if (area == 0.0F) return false;
    const float depth = (weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) * ray.scale_z;
    const float t = depth / area;
    if (std::isnan(t)) return false;
    hit.t = std::max(t, t_near);
    hit.u = weights[order.stored_corner(1)] / area;
    hit.v = weights[order.stored_corner(2)] / area;
    return true;
}

}  // namespace

PairHits test_pair(const LeafPair& pair, const RaySetup& ray, float t_near) {
    const Sheared a = shear(pair.vertices[0], ray);
    const Sheared b = shear(pair.vertices[1], ray);
    const Sheared c = shear(pair.vertices[2], ray);
    const Side common = edge_side(a, c);

    PairHits result;
    const Sides first{edge_side(c, b), common, edge_side(b, a)};
    result.is_pierced[0] = !pair.is_degenerate(0) &&
                           intersect({a, b, c}, first, ray, t_near, pair.corner_order(0), result.hits[0]);
    result.hits[0].primitive_id = pair.primitive_ids[0];
    if (!pair.has_second()) return result;

    const Sheared d = shear(pair.vertices[3], ray);
    const Sides second{edge_side(d, c), edge_side(a, d), opposite(common)};
    result.is_pierced[1] = !pair.is_degenerate(1) &&
                           intersect({a, c, d}, second, ray, t_near, pair.corner_order(1), result.hits[1]);
    result.hits[1].primitive_id = pair.primitive_ids[1];
    return result;
}

}  // namespace rtu::model
