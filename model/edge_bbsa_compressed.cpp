#include "model/edge_bbsa_compressed.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "model/edge_bbsa.hpp"
#include "model/edge_ring.hpp"
#include "model/edge_table.hpp"
#include "model/radix_sort.hpp"

namespace rtu::model {
namespace {

constexpr std::uint32_t key_bits = 24, key_end = 1U << key_bits;

struct CompressedHalfEdge {
    CompressedEdgeKey key;
    std::uint32_t triangle;
};
static_assert(sizeof(CompressedHalfEdge) == 16);

Aabb corner_box(const IdentifiedMesh& mesh) {
    Aabb box;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) box.extend(mesh.positions[vertex]);
    }
    return box;
}

/// Binary64, so that the sum is exact enough for no bit of a 24-bit result to depend on the order of a and b.
std::uint32_t quantise_middle(float a, float b, float lo, float hi) {
    const double extent = double(hi) - double(lo);
    if (!(extent > 0)) return 0;
    const double place = ((double(a) + double(b)) * 0.5 - double(lo)) / extent * double(key_end);
    return std::min(std::uint32_t(place), key_end - 1);
}

std::span<CompressedHalfEdge> sorted_table(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const Aabb scene = corner_box(mesh);
    const auto table = memory.take<CompressedHalfEdge>(3 * mesh.triangles.size());
    std::size_t count = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle corners = mesh.corners(t);
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint32_t a = corners[side], b = corners[(side + 1) % 3];
            if (a != b) table[count++] = {compress_edge(mesh.positions[a], mesh.positions[b], scene), t};
        }
    }
    const ScratchMemory::Scope scope(memory);
    const auto scratch = memory.take<CompressedHalfEdge>(count);
    for (const std::size_t word : {2U, 1U, 0U}) {
        radix_sort(table.first(count), scratch, [=](const CompressedHalfEdge& h) { return h.key[word]; });
    }
    return table.first(count);
}

/// Calls visit(triangle, other) for every candidate of the table.
template <class Visit>
void for_each_candidate(std::span<const CompressedHalfEdge> table, Visit visit) {
    for (std::size_t i = 1; i < table.size(); ++i) {
        const CompressedHalfEdge &a = table[i - 1], &b = table[i];
        if (a.key == b.key && a.triangle != b.triangle) visit(a.triangle, b.triangle);
    }
}

}  // namespace

CompressedEdgeKey compress_edge(Vec3 a, Vec3 b, const Aabb& scene) {
    const std::uint32_t area = std::bit_cast<std::uint32_t>(edge_box_area(a, b)) >> 7;
    const std::uint32_t rank = key_end - 1 - area;
    const std::uint32_t x = quantise_middle(a.x, b.x, scene.lo.x, scene.hi.x);
    const std::uint32_t y = quantise_middle(a.y, b.y, scene.lo.y, scene.hi.y);
    const std::uint32_t z = quantise_middle(a.z, b.z, scene.lo.z, scene.hi.z);
    return {rank << 8 | x >> 16, x << 16 | y >> 8, y << 24 | z};
}

Matching match_compressed(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto table = sorted_table(mesh, memory);
    Matching matching(std::uint32_t(mesh.triangles.size()), memory);
    for_each_candidate(table, [&](std::uint32_t a, std::uint32_t b) {
        if (!matching.is_free(a) || !matching.is_free(b)) return;
        if (const auto edge = common_edge(mesh, a, b)) matching.try_pair(edge->first, edge->second);
    });
    return matching;
}

CompressionCost compression_cost(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const ScratchMemory::Scope scope(memory);
    CompressionCost cost;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    for_each_candidate(sorted_table(mesh, memory), [&](std::uint32_t a, std::uint32_t b) {
        ++cost.candidates;
        if (!common_edge(mesh, a, b)) ++cost.wrong_candidates;
        found.push_back(std::minmax({a, b}));
    });
    std::ranges::sort(found);
    for_each_twin(mesh, memory, [&](std::uint32_t, std::uint32_t, HalfEdge a, HalfEdge b) {
        if (a.triangle() == b.triangle()) return;
        ++cost.exact_candidates;
        const std::pair pair = std::minmax({a.triangle(), b.triangle()});
        if (!std::ranges::binary_search(found, pair)) ++cost.lost_candidates;
    });
    return cost;
}

}  // namespace rtu::model
