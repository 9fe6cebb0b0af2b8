#pragma once

#include "model/mesh.hpp"

namespace rtu::model {

/// The hall of the built-in scene: 24 m x 7 m x 10 m around x = z = 0 on the floor y = 0, with tiles, two
/// rows of fluted columns under arches, beams, and windows with blinds. Most triangles are long and thin, and
/// most faces share no vertex index. Every slat carries one triangle of three points on a line, as
/// T-junctions leave behind.
[[nodiscard]] TriangleMesh builtin_hall();

}  // namespace rtu::model
