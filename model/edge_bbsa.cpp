#include "model/edge_bbsa.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/blocks.hpp"
#include "model/mutual_choice.hpp"

namespace rtu::model {
namespace {

/// Whether side i of a triangle comes before its side k, i < k, where the areas are equal.
bool breaks_tie(const Triangle& ids, std::uint32_t i, std::uint32_t k) {
    const auto edge = [&ids](std::uint32_t side) { return std::minmax(ids[side], ids[(side + 1) % 3]); };
    return edge(i) <= edge(k);
}

SideOrder order_of_sides(const IdentifiedMesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    const float pq = edge_box_area(p, q), qr = edge_box_area(q, r), rp = edge_box_area(r, p);
    bool ab_bc = pq > qr, bc_ca = qr > rp, ab_ca = pq > rp;
    if (pq == qr || qr == rp || pq == rp) {
        const Triangle ids = mesh.corners(triangle);
        ab_bc |= pq == qr && breaks_tie(ids, 0, 1);
        bc_ca |= qr == rp && breaks_tie(ids, 1, 2);
        ab_ca |= pq == rp && breaks_tie(ids, 0, 2);
    }
    return {ab_bc, bc_ca, ab_ca};
}

}  // namespace

float edge_box_area(Vec3 a, Vec3 b) {
    const float dx = std::fabs(a.x - b.x), dy = std::fabs(a.y - b.y), dz = std::fabs(a.z - b.z);
    const float area = dx * dy + dy * dz + dz * dx;
    return area >= 0 ? area : std::numeric_limits<float>::infinity();  // NaN: an infinite extent times zero
}

Matching match_by_edge_area(const IdentifiedMesh& mesh, const EdgeRings& rings, ScratchMemory& memory) {
    const auto orders = memory.take<SideOrder>(mesh.triangles.size());
    Blocks::of_items(orders.size()).for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (auto t = std::uint32_t(begin); t < end; ++t) orders[t] = order_of_sides(mesh, t);
    });
    return match_by_mutual_choice(orders, rings, memory);
}

}  // namespace rtu::model
