#include "model/edge_bbsa.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "model/edge_table.hpp"
#include "model/radix_sort.hpp"

namespace rtu::model {

float edge_box_area(Vec3 a, Vec3 b) {
    const float dx = std::fabs(a.x - b.x), dy = std::fabs(a.y - b.y), dz = std::fabs(a.z - b.z);
    const float area = dx * dy + dy * dz + dz * dx;
    return area >= 0 ? area : std::numeric_limits<float>::infinity();  // NaN: an infinite extent times zero
}

std::span<PairCandidate> pair_candidates(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto table = memory.take<PairCandidate>(3 * mesh.triangles.size());  // more than there can be
    std::size_t count = 0;
    for_each_twin(mesh, memory,
                  [&](std::uint32_t lower, std::uint32_t upper, HalfEdge first, HalfEdge second) {
                      const float area = edge_box_area(mesh.positions[lower], mesh.positions[upper]);
                      table[count++] = {~std::bit_cast<std::uint32_t>(area), first, second};
                  });
    const auto candidates = table.first(count);
    const ScratchMemory::Scope scope(memory);
    radix_sort(candidates, memory.take<PairCandidate>(count),
               [](const PairCandidate& candidate) { return candidate.rank; });
    return candidates;
}

Matching match_greedily(std::span<const PairCandidate> candidates, std::uint32_t triangle_count,
                        ScratchMemory& memory) {
    Matching matching(triangle_count, memory);
    for (const PairCandidate& candidate : candidates) matching.try_pair(candidate.first, candidate.second);
    return matching;
}

}  // namespace rtu::model
