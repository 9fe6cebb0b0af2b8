#include "model/edge_ring.hpp"

namespace rtu::model {

std::span<const HalfEdge> edge_rings(const IdentifiedMesh& mesh, std::span<const PairCandidate> candidates,
                                     ScratchMemory& memory) {
    const auto next = memory.take<HalfEdge>(3 * mesh.triangles.size());
    for (std::uint32_t i = 0; i < next.size(); ++i) next[i] = {i};
    for (const auto& [rank, first, second] : candidates) {
        next[second.index] = next[first.index];  // back to the first of the edge
        next[first.index] = second;
    }
    return next;
}

std::optional<std::pair<HalfEdge, HalfEdge>> common_edge(const IdentifiedMesh& mesh, std::uint32_t first,
                                                         std::uint32_t second) {
    if (first == second) return std::nullopt;
    const Triangle a = mesh.corners(first), b = mesh.corners(second);
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t p = a[i], q = a[(i + 1) % 3];
        for (std::uint32_t k = 0; k < 3 && p != q; ++k) {
            const std::uint32_t r = b[k], s = b[(k + 1) % 3];
            if ((p == r && q == s) || (p == s && q == r)) return {{{3 * first + i}, {3 * second + k}}};
        }
    }
    return std::nullopt;
}

}  // namespace rtu::model
