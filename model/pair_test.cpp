#include "model/pair_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/exact_triangle.hpp"

namespace rtu::model {

namespace {

// A vertex relative to the ray: the ray runs through (0, 0) along z.
struct Sheared {
    float x, y, z;
};

// How far corners lie from the ray's origin: largest |x| + |y|, largest |z|.
struct Reach {
    float across, along;
};

Sheared shear(Vec3 vertex, const RaySetup& ray) {
    const Vec3 a = vertex - ray.origin;
    const float z = a[ray.kz];
    return {a[ray.kx] - ray.shear_x * z, a[ray.ky] - ray.shear_y * z, z};
}

Reach reach(Sheared p) { return {std::abs(p.x) + std::abs(p.y), std::abs(p.z)}; }

Reach larger(Reach a, Reach b) { return {std::max(a.across, b.across), std::max(a.along, b.along)}; }

float edge_function(Sheared p, Sheared q) { return p.x * q.y - p.y * q.x; }

enum class FirstPass : std::uint8_t { Missed, Inside, Open };

// What the signs of a triangle's edge functions say beyond doubt. The bound on their rounding errors is
// derived in docs/model.md; one so large that products may have overflowed proves nothing.
FirstPass first_pass(float u, float v, float w, Reach reach) {
    constexpr float scale = 0x1p-20F, smallest = 0x1p-126F, largest = 0x1p100F;
    const float bound =
        scale * (reach.across + scale * reach.along) * (reach.across + reach.along) + smallest;
    const float low = std::min(std::min(u, v), w), high = std::max(std::max(u, v), w);
    if (low < -bound && high > bound && bound < largest) return FirstPass::Missed;
    return (low > bound || high < -bound) && bound < largest ? FirstPass::Inside : FirstPass::Open;
}

// The plane is not parallel to the ray when the sides agree: the edge functions add up to direction . n.
std::optional<Hit> intersect(const std::array<Vec3, 3>& corners, const RaySetup& ray) {
    const ExactTriangle triangle({ray.origin, ray.direction, ray.kz}, corners);
    std::array<Bounded, 3> edge_functions{};
    std::array<Side, 3> sides{};
    for (std::size_t edge = 0; edge < 3; ++edge) {
        edge_functions[edge] = triangle.edge_function(edge);
        sides[edge] = triangle.side(edge, edge_functions[edge]);
    }
    if (sides[0] != sides[1] || sides[1] != sides[2] || sides[0] == Side::Neither) return std::nullopt;
    const auto point = triangle.point_beyond(ray.t_min, edge_functions);
    return point ? std::optional(Hit{point->t, point->u, point->v}) : std::nullopt;
}

// In the file's order, so that a hit does not depend on how its triangle is stored.
std::array<Vec3, 3> corners_of(const LeafPair& pair, std::uint32_t triangle) {
    const auto& v = pair.vertices;
    const std::array<Vec3, 3> stored{v[0], v[1 + triangle], v[2 + triangle]};
    const CornerOrder order = pair.corner_order(triangle);
    return {stored[order.stored_corner(0)], stored[order.stored_corner(1)], stored[order.stored_corner(2)]};
}

void second_pass(const LeafPair& pair, std::uint32_t triangle, FirstPass first, const RaySetup& ray,
                 PairHits& result) {
    if (first == FirstPass::Missed || pair.is_degenerate(triangle)) return;
    ++result.exact_tests;
    result.side_tests += first == FirstPass::Open ? 1 : 0;
    const auto hit = intersect(corners_of(pair, triangle), ray);
    if (!hit) return;
    result.is_pierced[triangle] = true;
    result.hits[triangle] = *hit;
    result.hits[triangle].primitive_id = pair.primitive_ids[triangle];
}

}  // namespace

PairHits test_pair(const LeafPair& pair, const RaySetup& ray) {
    const Sheared a = shear(pair.vertices[0], ray);
    const Sheared b = shear(pair.vertices[1], ray);
    const Sheared c = shear(pair.vertices[2], ray);
    const float common = edge_function(a, c);
    const Reach shared = larger(reach(a), reach(c));

    PairHits result;
    second_pass(pair, 0,
                first_pass(edge_function(c, b), common, edge_function(b, a), larger(shared, reach(b))), ray,
                result);
    if (!pair.has_second()) return result;

    const Sheared d = shear(pair.vertices[3], ray);
    second_pass(pair, 1,
                first_pass(edge_function(d, c), edge_function(a, d), -common, larger(shared, reach(d))), ray,
                result);
    return result;
}

}  // namespace rtu::model
