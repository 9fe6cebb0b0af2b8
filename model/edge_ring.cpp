#include "model/edge_ring.hpp"

#include <algorithm>

#include "model/blocks.hpp"
#include "model/edge_table.hpp"

namespace rtu::model {

EdgeRings::EdgeRings(const IdentifiedMesh& mesh, ScratchMemory& memory)
    : next_(memory.take<HalfEdge>(3 * mesh.triangles.size())) {
    const ScratchMemory::Scope scope(memory);
    const EdgeGroups groups = group_half_edges(mesh, memory);
    Blocks::of_items(next_.size()).for_each([next = next_](std::size_t, std::size_t begin, std::size_t end) {
        for (auto i = std::uint32_t(begin); i < end; ++i) next[i] = {i};
    });
    const Blocks blocks = Blocks::of_groups(groups.count());
    std::vector<std::vector<Link>> links(blocks.count());
    blocks.for_each([&](std::size_t block, std::size_t begin, std::size_t end) {
        EdgeGroupSorter sorter(groups);
        for (std::size_t group = begin; group < end; ++group) {
            sorter.for_each_half_edge(group, [&](HalfEdge head, HalfEdge last, HalfEdge half_edge) {
                append(head, last, half_edge, links[block]);
            });
        }
    });
    for (const auto& part : links) previous_.insert(previous_.end(), part.begin(), part.end());
    std::ranges::sort(previous_, {}, &Link::half_edge);
}

std::optional<HalfEdge> EdgeRings::previous(HalfEdge h) const {
    const auto link = std::ranges::lower_bound(previous_, h, {}, &Link::half_edge);
    if (link == previous_.end() || link->half_edge != h) return std::nullopt;
    return link->previous;
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
