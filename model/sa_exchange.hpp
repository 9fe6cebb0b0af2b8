#pragma once

#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// `sa_exchange`: the greedy matching of edge_bbsa, then one pass of exchanges over the same candidates in
/// the same order. Where one triangle of a candidate is free and the other is paired, the free one takes the
/// other away from its partner if that pays, and the partner takes its best free neighbour instead, if it has
/// one that pays. Weight of a pair: its saving in surface area less half the growth of its box, which also
/// enlarges the boxes above (docs/pairing.md). No exchange lowers the sum of the weights.
[[nodiscard]] Matching match_with_exchanges(const IdentifiedMesh& mesh, ScratchMemory& memory);

}  // namespace rtu::model
