#include "study/scene_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <ctime>
#include <tuple>
#include <utility>

#include "model/builtin_scene.hpp"
#include "model/bvh.hpp"
#include "model/error.hpp"
#include "model/gltf.hpp"
#include "model/traversal.hpp"
#include "sim/machine.hpp"
#include "study/check.hpp"
#include "study/fingerprint.hpp"
#include "study/pixel_data.hpp"
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

class Stopwatch {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void tell(const RunOptions& options, const std::string& phase) {
    if (options.progress) options.progress(phase);
}

model::TriangleMesh load(const SceneSource& source) {
    return source.file ? model::load_gltf(*source.file) : model::builtin_scene();
}

SceneFacts facts(const model::TriangleMesh& mesh, const SceneSource& source) {
    return {source.name(), mesh.triangles.size(), mesh.positions.size(), model::count_degenerate(mesh)};
}

PairingFacts facts(const model::Pairing& pairing, const RunOptions& options, double seconds) {
    return {model::to_string(options.pairing),
            std::string(model::to_string(options.edge_identity)),
            pairing.paired_percent(),
            pairing.pair_count,
            pairing.single_count,
            seconds};
}

BvhFacts facts(const model::MemoryImage& image, double seconds) {
    return {image.width, image.node_count, image.leaf_count, image.size_bytes(), seconds};
}

using NamedCamera = std::pair<model::Camera, std::string>;

// The scene's camera, and where it comes from.
NamedCamera choose_camera(const model::TriangleMesh& mesh, const model::MemoryImage& image,
                          const SceneSource& source, const RunOptions& options) {
    if (options.camera_file) {
        if (const auto camera = model::load_camera(*options.camera_file, source.name())) {
            return NamedCamera{*camera, options.camera_file->filename().string()};
        }
    }
    if (!source.file) return NamedCamera{model::builtin_camera(), "built-in"};
    return NamedCamera{model::automatic_camera(mesh, image), "automatic"};
}

std::vector<UnitReport> reports(const std::vector<sim::UnitResult>& units) {
    std::vector<UnitReport> result;
    for (const sim::UnitResult& unit : units) {
        UnitReport& report = result.emplace_back(UnitReport{unit.name, unit.cycles, {}});
        for (const sim::CounterValue& c : unit.counters) {
            report.counters.push_back({std::string(c.name), std::string(c.unit), c.value});
        }
    }
    return result;
}

WorkloadReport report(const model::Workload& workload, const sim::MachineResult& result) {
    WorkloadReport report;
    report.name = workload.name;
    report.ray_count = workload.rays.size();
    for (const auto& hit : result.hits) report.hit_count += hit ? 1 : 0;
    report.box_tests = result.counts.box_tests;
    report.node_visits = result.counts.node_visits;
    report.pair_tests = result.counts.pair_tests;
    report.triangle_tests = result.counts.triangle_tests;
    report.cycles = result.cycles;
    report.units = reports(result.units);
    report.memory = reports(result.memory);
    return report;
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

// Pairs the mesh, builds the tree, proves the image right, and notes down what came out.
model::MemoryImage build(const model::TriangleMesh& mesh, const RunOptions& options, SceneReport& scene) {
    const Stopwatch pairing_watch;
    const model::Pairing pairing = model::pair_triangles(mesh, options.pairing, options.edge_identity);
    scene.pairing = facts(pairing, options, pairing_watch.seconds());
    const Stopwatch build_watch;
    model::MemoryImage image =
        model::build_bvh(mesh, pairing, {options.config.bvh.width, options.config.bvh.max_leaf_pairs});
    scene.bvh = facts(image, build_watch.seconds());
    model::validate(image, mesh);
    return image;
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
    scene.workloads.push_back(report(workload, result));
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
    const model::TriangleMesh mesh = load(source);
    scene.scene = facts(mesh, source);
    scene.input_hash = fingerprint(mesh);
    tell(options, "pairing and building the tree");
    const model::MemoryImage image = build(mesh, options, scene);
    std::tie(scene.camera, scene.camera_source) = choose_camera(mesh, image, source, options);

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
