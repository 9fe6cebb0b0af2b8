#pragma once

#include "study/run_options.hpp"
#include "study/timeline/timeline.hpp"

namespace rtu::study {

/// Simulates the first workload of the options, all of it, and tells what happened in the window. Throws
/// Error when the run ends before the window begins.
[[nodiscard]] Timeline run_timeline(const RunOptions& options, const SceneSource& source,
                                    const TimelineWindow& window);

}  // namespace rtu::study
