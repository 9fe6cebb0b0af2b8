#pragma once

#include "model/edge_ring.hpp"
#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/vec3.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Half the surface area of the box around an edge, dx dy + dy dz + dz dx from left to right in binary32; the
/// factor 2 is left out, as it changes no order. Symmetric in a and b. Infinity when it overflows, never NaN.
[[nodiscard]] float edge_box_area(Vec3 a, Vec3 b);

/// `edge_bbsa`: what the greedy scan of [AF] accepts of the candidates (neighbours on an edge) in the order
/// of its sorted half-edge table: area of the edge's box descending, then lower and upper vertex, then
/// half-edge ascending. The scan accepts a candidate exactly when both of its triangles have no better one
/// left, so the order of each triangle's own sides decides and nothing is sorted: triangles that are each
/// other's first choice are paired, on all cores, and the rest choose again. `rings` are the mesh's.
[[nodiscard]] Matching match_by_edge_area(const IdentifiedMesh& mesh, const EdgeRings& rings,
                                          ScratchMemory& memory);

}  // namespace rtu::model
