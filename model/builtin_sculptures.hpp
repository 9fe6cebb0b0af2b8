#pragma once

#include "model/mesh.hpp"

namespace rtu::model {

/// A sphere of radius 1 around the origin: an icosahedron with every triangle cut in four `levels` times.
/// 20 * 4^levels triangles that share their vertices.
[[nodiscard]] TriangleMesh icosphere(int levels);

/// An icosphere of radius about 1, pushed in and out by several octaves of ridged noise: a finely tessellated
/// organic shape, like a scan.
[[nodiscard]] TriangleMesh coral(int levels);

/// A tube along the (2, 3) torus knot around the y axis, about 3 in radius.
[[nodiscard]] TriangleMesh torus_knot();

/// A ball of narrow ribbons, about 1 in radius, in strip order: each two successive triangles share an edge.
/// Every sixth ribbon ends with a triangle of which two corners coincide, as strip generators leave behind.
[[nodiscard]] TriangleMesh hairball();

}  // namespace rtu::model
