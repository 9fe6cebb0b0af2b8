#include "study/timeline/timeline_study.hpp"

#include "model/error.hpp"
#include "study/ray_origin.hpp"
#include "study/timeline/timeline_recorder.hpp"
#include "study/version.hpp"
#include "study/workload_stream.hpp"

namespace rtu::study {

Timeline run_timeline(const RunOptions& options, const SceneSource& source, const TimelineWindow& window) {
    const std::unique_ptr<PreparedScene> scene = prepare_scene(options, source);
    WorkloadStream rays(make_chunk_source(options, *scene));
    if (!rays.next_workload()) throw Error("{}: expected rays, found none", source.name());
    if (options.progress) options.progress(fmt::format("{}: simulating", rays.name()));
    TimelineRecorder recorder(window);
    const std::string workload = rays.name();
    const sim::MachineResult result = sim::simulate_observed(
        options.config, scene->built.image, rays, rays.kind(), [](const std::optional<model::Hit>&) {},
        recorder, options.clock_mode);
    if (window.from >= result.cycles) {
        throw Error("expected a window that begins before cycle {}, the end of {}, got one from {}",
                    result.cycles, workload, window.from);
    }
    Timeline timeline = recorder.finish(result.cycles);
    timeline.scene = source.name();
    timeline.workload = workload;
    timeline.version = std::string(version());
    timeline.clock_mhz = options.config.clock_mhz;
    return timeline;
}

}  // namespace rtu::study
