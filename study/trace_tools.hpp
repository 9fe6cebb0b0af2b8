#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/run_options.hpp"
#include "traces/recover.hpp"

// What `rtusim trace` does besides replaying, which is a run.

namespace rtu::study {

/// Writes the rays of a run, or its traversals, to a trace; nothing is simulated. Returns what was written.
/// Memory does not grow with the number of rays. Throws Error as run_scene() does.
std::vector<traces::WorkloadCount> record_trace(const RunOptions& options, const SceneSource& source,
                                                const std::filesystem::path& output,
                                                traces::TraceContent content);

/// Rays from one format to another.
struct Conversion {
    RayInput input;
    std::filesystem::path output;
    traces::RayFormat output_format = traces::RayFormat::Trace;
    std::optional<std::string> only_workload;  ///< leaves the others out
    std::optional<SceneSource> scene;          ///< the trace is tied to it; else to what the input is tied to
};

/// Returns what was written. Throws Error for input that cannot be read or has no rays, and for output that
/// cannot be written or cannot hold them.
std::vector<traces::WorkloadCount> convert_rays(const Conversion& conversion);

/// Where a trace comes from and what it holds, as text.
[[nodiscard]] std::string describe_trace(const traces::TraceSurvey& survey, const std::string& file);

/// Workloads with their kinds and counts, as a table.
[[nodiscard]] std::string workload_counts(const std::vector<traces::WorkloadCount>& workloads);

/// "1,234 rays" over all workloads.
[[nodiscard]] std::string total_rays(const std::vector<traces::WorkloadCount>& workloads);

}  // namespace rtu::study
