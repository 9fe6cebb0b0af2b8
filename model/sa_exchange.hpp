#pragma once

#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// `sa_exchange`: the greedy matching of edge_bbsa, then one pass over the triangles that it leaves free, in
/// file order. Each takes away from its partner the neighbour where that pays most, if anywhere (ties: its
/// lowest side); the partner left takes its best free neighbour that pays, if it has one. Weight of a pair:
/// its saving in surface area less half the growth of its box, which also enlarges the boxes above
/// (docs/pairing.md). No exchange lowers the sum of the weights. Neighbours on an edge of more than two
/// half-edges: each sees the next in file order, the last the first.
[[nodiscard]] Matching match_with_exchanges(const IdentifiedMesh& mesh, ScratchMemory& memory);

}  // namespace rtu::model
