#pragma once

#include "study/run_options.hpp"
#include "study/stability/stability_cases.hpp"

namespace rtu::study {

/// A scene's own triangles as a case, number 25 and called `scene`: rays from the middles of other triangles,
/// aimed inside a triangle, or at an edge or a vertex, where all triangles around are asked. A scene is
/// seldom closed: leaks and doubles are against the crossings of exact arithmetic. Throws Error as
/// load_scene() does, and for a scene of degenerate triangles only.
[[nodiscard]] StabilityCase scene_case(const SceneSource& source);

}  // namespace rtu::study
