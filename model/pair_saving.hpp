#pragma once

#include "model/half_edge.hpp"
#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Half the surface areas of the boxes around two triangles and around both; binary32 each.
struct PairAreas {
    float first = 0, second = 0, both = 0;

    /// What a leaf of both saves over two leaves in expected pair tests, times half the area of the scene's
    /// box: a random ray meets a box in proportion to its area. Negative when the pair does not pay.
    [[nodiscard]] double saving() const { return double(first) + double(second) - double(both); }
    /// How much larger the box of both is than the larger of the two.
    [[nodiscard]] double growth() const { return double(both) - double(first > second ? first : second); }
};

/// The areas of the triangles of two different half-edges that lie on the same edge. An area that overflows
/// is infinite or NaN.
[[nodiscard]] PairAreas pair_areas(const IdentifiedMesh& mesh, HalfEdge first, HalfEdge second);

/// `sa_saving`: greedy by descending saving() in binary32 (NaN counts as -infinity), ties as in edge_bbsa.
/// What edge_bbsa approximates with the box of the common edge alone.
[[nodiscard]] Matching match_by_saving(const IdentifiedMesh& mesh, ScratchMemory& memory);

}  // namespace rtu::model
