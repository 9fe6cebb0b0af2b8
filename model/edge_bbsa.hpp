#pragma once

#include <span>

#include "model/pair_candidates.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Half the surface area of the box around an edge, dx dy + dy dz + dz dx from left to right in binary32; the
/// factor 2 is left out, as it changes no order. Symmetric in a and b. Infinity when it overflows, never NaN.
[[nodiscard]] float edge_box_area(Vec3 a, Vec3 b);

/// The candidates of [AF] in the order of the sorted half-edge table: area of the edge's box descending, then
/// lower and upper vertex, then half-edge ascending. The paper's scan compares neighbours of the table only,
/// so entries without an equal neighbour need not be kept.
[[nodiscard]] std::span<PairCandidate> edge_bbsa_candidates(const IdentifiedMesh& mesh,
                                                            ScratchMemory& memory);

}  // namespace rtu::model
