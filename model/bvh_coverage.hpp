#pragma once

#include <span>

#include "model/aabb.hpp"
#include "model/memory_image.hpp"

namespace rtu::model {

/// Whether the boxes [one or more] of the leaves that refer to `pair` hold its triangles: each corner
/// exactly, and of each triangle the points of a grid of 16 steps along its sides, computed in binary64,
/// within its rounding. A cheap look at every tree; the tests subtract the boxes from the triangles exactly.
[[nodiscard]] bool is_covered(const LeafPair& pair, std::span<const Aabb> boxes);

}  // namespace rtu::model
