#pragma once

#include <cstdint>
#include <span>

#include "model/half_edge.hpp"
#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Half the surface area of the box around an edge, dx dy + dy dz + dz dx from left to right in binary32; the
/// factor 2 is left out, as it changes no order. Symmetric in a and b. Infinity when it overflows, never NaN.
[[nodiscard]] float edge_box_area(Vec3 a, Vec3 b);

/// Two neighbouring entries of the sorted half-edge table that lie on the same edge.
struct PairCandidate {
    std::uint32_t rank;  ///< the complement of the area's bits: ascends as the area descends
    HalfEdge first, second;
};

/// The candidates of [AF] in the order of the sorted half-edge table: area descending, then lower and upper
/// vertex, then half-edge ascending. The paper's scan compares neighbours of the table only, so entries
/// without an equal neighbour need not be kept, and n equal entries are n - 1 candidates.
[[nodiscard]] std::span<PairCandidate> pair_candidates(const IdentifiedMesh& mesh, ScratchMemory& memory);

/// The greedy scan of [AF]: a candidate is accepted when its two triangles are different and still free.
[[nodiscard]] Matching match_greedily(std::span<const PairCandidate> candidates, std::uint32_t triangle_count,
                                      ScratchMemory& memory);

}  // namespace rtu::model
