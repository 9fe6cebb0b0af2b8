#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "model/edge_table.hpp"
#include "model/half_edge.hpp"
#include "model/matching.hpp"
#include "model/radix_sort.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Two neighbouring entries of the half-edge table that lie on the same edge.
struct PairCandidate {
    std::uint32_t rank;  ///< ascends as the candidate's value descends: descending_rank
    HalfEdge first, second;
};

/// An integer that ascends as `value` descends; one-to-one. `value` must not be NaN. -0 comes after +0.
[[nodiscard]] constexpr std::uint32_t descending_rank(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x8000'0000U) != 0 ? bits : ~(bits | 0x8000'0000U);
}

/// Every candidate of the mesh, sorted by descending `value_of(lower_vertex, upper_vertex, first, second)`, a
/// float, then by lower and upper vertex, then by half-edge. An edge of n half-edges is n - 1 candidates.
template <class Value>
[[nodiscard]] std::span<PairCandidate> sorted_candidates(const IdentifiedMesh& mesh, ScratchMemory& memory,
                                                         Value value_of) {
    const auto table = memory.take<PairCandidate>(3 * mesh.triangles.size());  // more than there can be
    std::size_t count = 0;
    for_each_twin(
        mesh, memory, [&](std::uint32_t lower, std::uint32_t upper, HalfEdge first, HalfEdge second) {
            table[count++] = {descending_rank(value_of(lower, upper, first, second)), first, second};
        });
    const auto candidates = table.first(count);
    const ScratchMemory::Scope scope(memory);
    radix_sort(candidates, memory.take<PairCandidate>(count),
               [](const PairCandidate& candidate) { return candidate.rank; });
    return candidates;
}

/// Accepts each candidate in turn whose two triangles are different and still free.
[[nodiscard]] Matching match_greedily(std::span<const PairCandidate> candidates, std::uint32_t triangle_count,
                                      ScratchMemory& memory);

}  // namespace rtu::model
