#include "study/scene_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <ctime>
#include <optional>

#include "model/error.hpp"
#include "model/traversal.hpp"
#include "sim/machine.hpp"
#include "study/check.hpp"
#include "study/pixel_data.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {

namespace {

double cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

std::uint64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t(usage.ru_maxrss) * 1024;
}

void tell(const RunOptions& options, const std::string& phase) {
    if (options.progress) options.progress(phase);
}

SceneReport described(const RunOptions& options) {
    SceneReport scene;
    scene.version = version();
    scene.preset = options.preset;
    scene.seed = options.seed;
    scene.resolution = options.resolution;
    scene.clock_mhz = options.config.clock_mhz;
    scene.config = config_entries(options.config);
    return scene;
}

// Simulates one workload, checks it when there is a checker, and adds it to the report.
void run_workload(const model::Workload& workload, const model::MemoryImage& image, const RunOptions& options,
                  HitChecker* checker, SceneReport& scene) {
    const double simulation_start = cpu_seconds();
    const sim::MachineResult result = sim::simulate(
        options.config, image, workload.rays, workload.ray_kind, options.clock_mode,
        [&](double share) { tell(options, fmt::format("{}: {:.0f} %", workload.name, share * 100)); });
    scene.host.cpu_seconds += cpu_seconds() - simulation_start;
    scene.host.simulated_rays += workload.rays.size();
    scene.workloads.push_back(workload_report(workload, result));
    if (checker == nullptr) return;
    tell(options, workload.name + ": checking hits");
    const model::TraversalCounts counts = checker->check(workload, result.hits);
    RTU_CHECK(counts == result.counts,
              "{}: simulated and reference counts differ: {} and {} box tests, {} and {} pair tests",
              workload.name, result.counts.box_tests, counts.box_tests, result.counts.pair_tests,
              counts.pair_tests);
}

}  // namespace

SceneReport run_scene(const RunOptions& options, const SceneSource& source) {
    const double cpu_start = cpu_seconds();
    SceneReport scene = described(options);
    tell(options, "loading " + source.name());
    const LoadedScene loaded = load_scene(source);
    const model::TriangleMesh& mesh = loaded.mesh;
    scene.scene = loaded.facts;
    scene.input_hash = loaded.input_hash;
    tell(options, "pairing and building the tree");
    const BuiltScene built = build_scene(mesh, options.pairing, options.edge_identity, options.config.bvh);
    const model::MemoryImage& image = built.image;
    scene.pairing = built.pairing;
    scene.bvh = built.bvh;
    const ChosenCamera chosen = choose_camera(mesh, image, source, options.camera_file);
    scene.camera = chosen.camera;
    scene.camera_source = chosen.source;

    std::optional<HitChecker> checker;
    if (options.is_checked) checker.emplace(mesh, image);
    for (const model::WorkloadKind kind : options.workloads) {
        tell(options, fmt::format("{}: making rays", model::to_string(kind)));
        const model::Workload workload =
            model::make_workload(kind, mesh, image, scene.camera, options.resolution, options.seed);
        run_workload(workload, image, options, checker ? &*checker : nullptr, scene);
    }
    if (checker) scene.check = checker->report();
    if (options.wants_pixels) scene.pixels = trace_pixels(mesh, image, scene.camera, options.resolution);
    scene.host.total_cpu_seconds = cpu_seconds() - cpu_start;
    scene.host.peak_rss_bytes = peak_rss_bytes();
    return scene;
}

}  // namespace rtu::study
