#pragma once

#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// A search for two partners on one edge looks at this many triangles before and after each, so that an edge
/// of very many triangles costs linear time. On an edge of more the matching may miss the maximum.
inline constexpr std::uint32_t max_edge_reach = 32;

/// `maximum`: as many pairs as there can be, whatever their shape: a maximum-cardinality matching of the dual
/// graph, in which two triangles with a common edge are neighbours. The upper bound of paired percent.
/// From edge_bbsa's matching, alternating searches augment what they can; Edmonds' algorithm (Boost.Graph)
/// completes each connected component that still has two free triangles or more.
[[nodiscard]] Matching match_maximum(const IdentifiedMesh& mesh, ScratchMemory& memory);

}  // namespace rtu::model
