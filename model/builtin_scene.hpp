#pragma once

#include "model/mesh.hpp"

namespace rtu::model {

struct Camera;

/// A procedural scene of 100,000 to 300,000 triangles that exercises the machine: smooth tessellated shapes
/// in shuffled triangle order, architecture with long thin triangles, a hairball built of strips, split
/// vertices, some degenerate triangles. Bit-equal on every machine: built with +, -, *, / and sqrt only.
/// Units: metres, y up.
[[nodiscard]] TriangleMesh builtin_scene();

/// A view of the built-in scene down its hall.
[[nodiscard]] Camera builtin_camera();

}  // namespace rtu::model
