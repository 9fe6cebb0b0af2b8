#pragma once

// Pairing as the definitions read, slow and without cleverness: what the fast implementation is compared
// with.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "model/mesh.hpp"
#include "model/pairing.hpp"

namespace rtu::test {

using Partners = std::vector<std::optional<std::uint32_t>>;  ///< [triangle_count] nothing for a lone triangle

/// One column of the paper's table.
struct HalfEdgeRecord {
    float area;
    std::uint32_t lower, upper, triangle;
};

/// For every vertex the lowest one that is the same under `identity`.
inline std::vector<std::uint32_t> identify(const model::TriangleMesh& mesh, model::EdgeIdentity identity) {
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> seen;
    std::vector<std::uint32_t> result;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(mesh.positions[v]);
        const std::uint32_t first = seen.try_emplace(bits, v).first->second;
        result.push_back(identity == model::EdgeIdentity::Position ? first : v);
    }
    return result;
}

/// The half-edge table as it is constructed, triangle by triangle.
inline std::vector<HalfEdgeRecord> half_edges(const model::TriangleMesh& mesh,
                                              const std::vector<std::uint32_t>& identity) {
    std::vector<HalfEdgeRecord> table;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint32_t i = mesh.triangles[t][side], j = mesh.triangles[t][(side + 1) % 3];
            if (identity[i] == identity[j]) continue;
            const model::Vec3 d = mesh.positions[i] - mesh.positions[j];
            const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
            const float area = x * y + y * z + z * x;
            const float key = std::isnan(area) ? std::numeric_limits<float>::infinity() : area;
            table.push_back({key, std::min(identity[i], identity[j]), std::max(identity[i], identity[j]), t});
        }
    }
    return table;
}

/// The whole half-edge table in the paper's order, ties by triangle.
inline std::vector<HalfEdgeRecord> half_edge_table(const model::TriangleMesh& mesh,
                                                   const std::vector<std::uint32_t>& identity) {
    std::vector<HalfEdgeRecord> table = half_edges(mesh, identity);
    std::ranges::stable_sort(table, [](const HalfEdgeRecord& a, const HalfEdgeRecord& b) {
        if (a.area != b.area) return a.area > b.area;
        if (a.lower != b.lower) return a.lower < b.lower;
        if (a.upper != b.upper) return a.upper < b.upper;
        return a.triangle < b.triangle;
    });
    return table;
}

/// Accepts equal neighbours of the table in turn.
inline Partners scan(const model::TriangleMesh& mesh, const std::vector<HalfEdgeRecord>& table) {
    Partners partners(mesh.triangles.size());
    for (std::size_t i = 1; i < table.size(); ++i) {
        const HalfEdgeRecord &a = table[i - 1], &b = table[i];
        const bool is_same_edge = a.lower == b.lower && a.upper == b.upper;
        if (!is_same_edge || a.triangle == b.triangle) continue;
        if (partners[a.triangle] || partners[b.triangle]) continue;
        partners[a.triangle] = b.triangle;
        partners[b.triangle] = a.triangle;
    }
    return partners;
}

inline Partners reference_edge_bbsa(const model::TriangleMesh& mesh, model::EdgeIdentity identity) {
    return scan(mesh, half_edge_table(mesh, identify(mesh, identity)));
}

/// What one leaf of both triangles saves over two leaves, in half areas of their boxes.
inline float saving(const model::TriangleMesh& mesh, std::uint32_t s, std::uint32_t t) {
    model::Aabb a, b;
    for (const std::uint32_t v : mesh.triangles[s]) a.extend(mesh.positions[v]);
    for (const std::uint32_t v : mesh.triangles[t]) b.extend(mesh.positions[v]);
    model::Aabb both = a;
    both.extend(b);
    const auto value = float(double(a.half_area()) + double(b.half_area()) - double(both.half_area()));
    return std::isnan(value) ? -std::numeric_limits<float>::infinity() : value;
}

inline Partners reference_sa_saving(const model::TriangleMesh& mesh, model::EdgeIdentity identity) {
    std::vector<HalfEdgeRecord> table = half_edge_table(mesh, identify(mesh, identity));
    std::ranges::stable_sort(table, [](const HalfEdgeRecord& a, const HalfEdgeRecord& b) {
        return std::pair(a.lower, a.upper) < std::pair(b.lower, b.upper);
    });
    std::vector<std::array<HalfEdgeRecord, 2>> candidates;
    for (std::size_t i = 1; i < table.size(); ++i) {
        const HalfEdgeRecord& a = table[i - 1];
        HalfEdgeRecord b = table[i];
        if (a.lower != b.lower || a.upper != b.upper) continue;
        b.area = saving(mesh, a.triangle, b.triangle);
        candidates.push_back({a, b});
    }
    std::ranges::stable_sort(candidates, [](const auto& a, const auto& b) { return a[1].area > b[1].area; });
    Partners partners(mesh.triangles.size());
    for (const auto& [a, b] : candidates) {
        if (a.triangle == b.triangle || partners[a.triangle] || partners[b.triangle]) continue;
        partners[a.triangle] = b.triangle;
        partners[b.triangle] = a.triangle;
    }
    return partners;
}

inline double exchange_weight(const model::TriangleMesh& mesh, std::uint32_t s, std::uint32_t t) {
    model::Aabb a, b;
    for (const std::uint32_t v : mesh.triangles[s]) a.extend(mesh.positions[v]);
    for (const std::uint32_t v : mesh.triangles[t]) b.extend(mesh.positions[v]);
    const double area_a = a.half_area(), area_b = b.half_area();
    a.extend(b);
    const double both = a.half_area();
    return area_a + area_b - both - (both - std::max(area_a, area_b)) / 2;
}

/// The triangle that follows `t` around each of its sides, in file order; none where it is alone.
inline Partners side_neighbours(const model::TriangleMesh& mesh, const std::vector<std::uint32_t>& ids,
                                std::uint32_t t) {
    Partners neighbours;
    for (std::uint32_t side = 0; side < 3; ++side) {
        const auto edge = std::minmax({ids[mesh.triangles[t][side]], ids[mesh.triangles[t][(side + 1) % 3]]});
        std::vector<std::uint32_t> half_edges;
        for (std::uint32_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
            const model::Triangle& u = mesh.triangles[h / 3];
            if (std::minmax({ids[u[h % 3]], ids[u[(h + 1) % 3]]}) == edge) half_edges.push_back(h);
        }
        const auto own = std::ranges::find(half_edges, 3 * t + side) - half_edges.begin();
        const std::uint32_t next = half_edges[std::size_t(own + 1) % half_edges.size()] / 3;
        const bool is_edge = edge.first != edge.second && next != t;
        neighbours.push_back(is_edge ? std::optional(next) : std::nullopt);
    }
    return neighbours;
}

inline Partners reference_sa_exchange(const model::TriangleMesh& mesh, model::EdgeIdentity identity) {
    const std::vector<std::uint32_t> ids = identify(mesh, identity);
    Partners partners = reference_edge_bbsa(mesh, identity);
    for (std::uint32_t free = 0; free < partners.size(); ++free) {
        if (partners[free]) continue;
        double best_gain = 0;
        std::optional<std::array<std::optional<std::uint32_t>, 3>> best;  // taken, its partner, the new one's
        for (const auto& taken : side_neighbours(mesh, ids, free)) {
            if (!taken || !partners[*taken]) continue;
            const std::uint32_t left = *partners[*taken];
            double offer = 0;
            std::optional<std::uint32_t> new_partner;
            for (const auto& other : side_neighbours(mesh, ids, left)) {
                if (!other || *other == free || partners[*other]) continue;
                const double weight = exchange_weight(mesh, left, *other);
                if (!(weight > offer)) continue;
                offer = weight;
                new_partner = other;
            }
            const double gain =
                exchange_weight(mesh, free, *taken) - exchange_weight(mesh, *taken, left) + offer;
            if (!(gain > best_gain)) continue;
            best_gain = gain;
            best = {taken, left, new_partner};
        }
        if (!best) continue;
        const auto [taken, left, new_partner] = *best;
        partners[free] = taken;
        partners[*taken] = free;
        partners[*left] = new_partner;
        if (new_partner) partners[*new_partner] = left;
    }
    return partners;
}

/// Whether two triangles have two different vertices in common.
inline bool share_edge(const model::Triangle& s, const model::Triangle& t,
                       const std::vector<std::uint32_t>& identity) {
    std::array<std::uint32_t, 3> common{};
    auto end = common.begin();
    for (const std::uint32_t i : s) {
        const bool is_in_t =
            std::ranges::any_of(t, [&](std::uint32_t j) { return identity[i] == identity[j]; });
        if (is_in_t && std::find(common.begin(), end, identity[i]) == end) *end++ = identity[i];
    }
    return end - common.begin() >= 2;
}

inline Partners reference_window(const model::TriangleMesh& mesh, std::uint32_t window,
                                 model::EdgeIdentity identity) {
    const std::vector<std::uint32_t> ids = identify(mesh, identity);
    Partners partners(mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::uint32_t j = i + 1; j < mesh.triangles.size() && j < i + window && !partners[i]; ++j) {
            if (partners[j] || !share_edge(mesh.triangles[i], mesh.triangles[j], ids)) continue;
            partners[i] = j;
            partners[j] = i;
        }
    }
    return partners;
}

/// Who is paired with whom in a pairing.
inline Partners partners_of(const model::Pairing& pairing, std::size_t triangle_count) {
    Partners partners(triangle_count);
    for (const model::TrianglePair& pair : pairing.pairs) {
        if (!pair.has_second) continue;
        partners[pair.primitive_ids[0]] = pair.primitive_ids[1];
        partners[pair.primitive_ids[1]] = pair.primitive_ids[0];
    }
    return partners;
}

}  // namespace rtu::test
