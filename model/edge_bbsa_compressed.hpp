#pragma once

// The compressed half-edge of [AF], 16 bytes:
//   bits 127-104  area     complement of the area's binary32 bits 30-7 (its sign bit is 0, the low 7 are cut)
//   bits 103-32   middle   x, y, z of the edge's midpoint, 24 bits each: floor(2^24 (m - lo) / (hi - lo)) in
//                          the box [lo, hi] of the scene's corners, at most 2^24 - 1
//   bits 31-0     triangle
// The paper gives the widths; the encoding is ours, as it prints none.

#include <array>
#include <cstdint>

#include "model/aabb.hpp"
#include "model/matching.hpp"
#include "model/pairing.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Area and midpoint of an edge in 24 bits each; ascends as the area descends. Symmetric in a and b.
using CompressedEdgeKey = std::array<std::uint32_t, 3>;
[[nodiscard]] CompressedEdgeKey compress_edge(Vec3 a, Vec3 b, const Aabb& scene);

/// `edge_bbsa_compressed`: edge_bbsa on the sorted compressed table. Neighbours with equal keys are
/// candidates, as in the paper; a candidate whose triangles have no edge in common is found out when the two
/// are paired, and passed over: an equal key costs a pair at worst, never geometry. Ties: as the half-edges
/// stand in the file.
[[nodiscard]] Matching match_compressed(const IdentifiedMesh& mesh, ScratchMemory& memory);

/// The candidates of a CompressionCost; its pair counts are left 0.
[[nodiscard]] CompressionCost compression_cost(const IdentifiedMesh& mesh, ScratchMemory& memory);

}  // namespace rtu::model
