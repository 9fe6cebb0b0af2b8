#pragma once

#include "study/report/run_report.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// Runs one scene: load -> pair -> build the tree and its memory image -> make or read the rays -> simulate
/// each on a fresh machine -> check when asked to. Workloads run in the order of `options.workloads`. Throws
/// Error for input that cannot be read or used, std::logic_error for a broken invariant or a machine that
/// stops making progress. A failed check is not an exception: see SceneReport::check.
[[nodiscard]] SceneReport run_scene(const RunOptions& options, const SceneSource& source);

}  // namespace rtu::study
