#include "model/window_pairing.hpp"

#include <optional>
#include <span>

#include "model/edge_table.hpp"

namespace rtu::model {
namespace {

/// For every half-edge the next one on the same edge; the last is its own next.
std::span<HalfEdge> link_twins(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto next = memory.take<HalfEdge>(3 * mesh.triangles.size());
    for (std::uint32_t i = 0; i < next.size(); ++i) next[i] = {i};
    for_each_twin(mesh, memory, [&](std::uint32_t, std::uint32_t, HalfEdge first, HalfEdge second) {
        next[first.index] = second;
    });
    return next;
}

/// The first half-edge after `side` on the same edge whose triangle is another, free, and before `end`.
std::optional<HalfEdge> find_partner(std::span<const HalfEdge> next, const Matching& matching, HalfEdge side,
                                     std::uint32_t end) {
    for (HalfEdge h = side; next[h.index] != h;) {
        h = next[h.index];
        if (h.triangle() >= end) break;
        if (h.triangle() != side.triangle() && matching.is_free(h.triangle())) return h;
    }
    return std::nullopt;
}

}  // namespace

Matching match_in_window(const IdentifiedMesh& mesh, std::uint32_t window, ScratchMemory& memory) {
    // Following the links visits only neighbours, so a wide window costs no more than a narrow one.
    const auto next = link_twins(mesh, memory);
    Matching matching(std::uint32_t(mesh.triangles.size()), memory);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!matching.is_free(t)) continue;
        HalfEdge own{3 * t}, partner = own;
        std::uint32_t end = t + window;
        for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
            if (const auto found = find_partner(next, matching, {side}, end)) {
                own = {side};
                partner = *found;
                end = found->triangle();
            }
        }
        matching.try_pair(own, partner);
    }
    return matching;
}

}  // namespace rtu::model
