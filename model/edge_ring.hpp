#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "model/half_edge.hpp"
#include "model/pair_candidates.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// For every half-edge the next one on its edge, the first after the last; its own next when it is alone.
/// `candidates` are all of the mesh's, those of one edge in the order of their half-edges: [3 T].
[[nodiscard]] std::span<const HalfEdge> edge_rings(const IdentifiedMesh& mesh,
                                                   std::span<const PairCandidate> candidates,
                                                   ScratchMemory& memory);

/// A side of each of two triangles that lies on an edge common to both: the lowest such side of
/// `first`, and there the lowest of `second`; an empty answer if they have none or are the same.
[[nodiscard]] std::optional<std::pair<HalfEdge, HalfEdge>> common_edge(const IdentifiedMesh& mesh,
                                                                       std::uint32_t first,
                                                                       std::uint32_t second);

}  // namespace rtu::model
