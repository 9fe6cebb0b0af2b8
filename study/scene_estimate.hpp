#pragma once

#include <vector>

#include "study/fidelity/fidelity_study.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// Tells the MRPS of a scene's workloads, or of a file's rays, at a level of fidelity. `tolerance` is a
/// share. Throws Error as run_scene() does, and for a traversal trace: estimates need rays.
[[nodiscard]] std::vector<FidelityRow> estimate_scene(const RunOptions& options, const SceneSource& source,
                                                      FidelityLevel level, double tolerance);

}  // namespace rtu::study
