#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "study/report/run_report.hpp"
#include "study/run_options.hpp"
#include "study/scene_steps.hpp"
#include "study/workload_stream.hpp"
#include "traces/trace_header.hpp"

// Where the rays of a scene come from: made for its workloads, or read from a file.

namespace rtu::study {

/// A scene that is ready for rays. Not copied: generators refer to it.
struct PreparedScene {
    LoadedScene loaded;
    BuiltScene built;
    SceneReport report;  ///< everything but the workloads
};

/// Loads and builds a scene, and chooses its camera or takes the picture of the trace, if there is one.
/// Throws Error when the file of rays cannot be opened, or was recorded on another scene or memory image.
[[nodiscard]] std::unique_ptr<PreparedScene> prepare_scene(const RunOptions& options,
                                                           const SceneSource& source);

/// The rays of the options' workloads, or those of the options' file. `scene` must outlive it.
[[nodiscard]] std::shared_ptr<traces::RayReader> make_ray_reader(const RunOptions& options,
                                                                 const PreparedScene& scene);

/// The same as chunks, and those of a traversal trace too.
[[nodiscard]] ChunkSource make_chunk_source(const RunOptions& options, const PreparedScene& scene);

/// What a trace recorded for this scene says at its start.
[[nodiscard]] traces::TraceHeader trace_header(const PreparedScene& scene, traces::TraceContent content);

}  // namespace rtu::study
