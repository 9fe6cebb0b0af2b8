#pragma once

#include <cstdint>

#include "model/aabb.hpp"
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

/// The box of one triangle's corners.
[[nodiscard]] Aabb triangle_box(const IdentifiedMesh& mesh, std::uint32_t triangle);

/// The areas of two triangles' boxes and of the box around both. An area that overflows is infinite or NaN.
[[nodiscard]] PairAreas pair_areas(const Aabb& first, const Aabb& second);

/// `sa_saving`: greedy by descending saving() in binary32 (NaN counts as -infinity), ties as in edge_bbsa.
/// What edge_bbsa approximates with the box of the common edge alone.
[[nodiscard]] Matching match_by_saving(const IdentifiedMesh& mesh, ScratchMemory& memory);

}  // namespace rtu::model
