#pragma once

#include <cstdint>

#include "model/mesh.hpp"

namespace rtu::model {

/// A procedural scene of 100,000 to 300,000 triangles that exercises the machine: smooth tessellated shapes in shuffled
/// triangle order, architecture with long thin triangles, a hairball built of strips, some degenerate triangles.
/// Bit-equal on every machine: built with +, -, *, / and sqrt only. Units: metres, y up.
[[nodiscard]] TriangleMesh builtin_scene();

}  // namespace rtu::model
