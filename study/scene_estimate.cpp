#include "study/scene_estimate.hpp"

#include <fmt/format.h>

#include <memory>

#include "model/error.hpp"
#include "study/ray_origin.hpp"
#include "traces/trace_reader.hpp"

namespace rtu::study {
namespace {

std::vector<std::unique_ptr<RayPopulation>> populations_of(const RunOptions& options,
                                                           const PreparedScene& scene) {
    if (options.rays) return file_populations(*make_ray_reader(options, scene));
    const model::WorkloadSetting setting(scene.loaded.mesh, scene.built.image, scene.report.camera,
                                         options.resolution, options.seed);
    std::vector<std::unique_ptr<RayPopulation>> populations;
    for (const model::WorkloadKind kind : options.workloads) {
        populations.push_back(picture_population(kind, setting));
    }
    return populations;
}

void check_has_rays(const RunOptions& options) {
    if (!options.rays || options.rays->format != traces::RayFormat::Trace) return;
    const traces::TraceReader reader(options.rays->file);
    if (reader.header().content == traces::TraceContent::Visits) {
        throw Error("{}: a traversal trace has no rays, and an estimate needs them; use --fidelity cycle",
                    options.rays->file.string());
    }
}

}  // namespace

std::vector<FidelityRow> estimate_scene(const RunOptions& options, const SceneSource& source,
                                        FidelityLevel level, double tolerance) {
    check_has_rays(options);
    const std::unique_ptr<PreparedScene> scene = prepare_scene(options, source);
    std::vector<FidelityRow> rows;
    for (const auto& population : populations_of(options, *scene)) {
        if (options.progress) options.progress(fmt::format("{}: estimating", population->name()));
        const LevelResult result =
            run_level(level, options.config, scene->built.image, *population, {tolerance, options.seed});
        FidelityRow& row = rows.emplace_back(fidelity_row(result, options.config.clock_mhz));
        row.scene = scene->report.scene.name;
        row.machine = options.preset;
        row.workload = population->name();
    }
    if (rows.empty()) throw Error("{}: expected rays, found none", options.rays->file.string());
    return rows;
}

}  // namespace rtu::study
