#pragma once

#include <cstdint>

#include "model/half_edge.hpp"
#include "model/mesh.hpp"
#include "model/pair.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// A lone triangle, stored in its file order.
[[nodiscard]] TrianglePair make_lone(const IdentifiedMesh& mesh, std::uint32_t triangle);

/// The pair of two different triangles on the common edge `first`, `second` (a side of each, with the same
/// two different ends by vertex identity; else throws std::logic_error). The triangle of `first` is stored as
/// triangle 0 and keeps its winding; v0 and v2 have its indices.
[[nodiscard]] TrianglePair make_pair(const IdentifiedMesh& mesh, HalfEdge first, HalfEdge second);

/// Triangle `which` (0 or 1) of a pair with its corners in file order: the inverse of make_pair and
/// make_lone. Where corners were identified by position, the common corners have triangle 0's indices. 1 of a
/// lone triangle equals 0.
[[nodiscard]] Triangle file_corners(const TrianglePair& pair, std::uint32_t which);

}  // namespace rtu::model
