#include "study/scene_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <optional>

#include "model/error.hpp"
#include "sim/machine.hpp"
#include "study/chart/pixel_data.hpp"
#include "study/check.hpp"
#include "study/checked_hits.hpp"
#include "study/cpu_time.hpp"
#include "study/ray_origin.hpp"
#include "study/scene_steps.hpp"
#include "study/workload_stream.hpp"

namespace rtu::study {

namespace {

std::uint64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t(usage.ru_maxrss) * 1024;
}

// Hands rays through and tells `hits` of them.
class TeeSupply final : public sim::RaySupply {
  public:
    TeeSupply(sim::RaySupply& rays, CheckedHits& hits) : rays_(rays), hits_(hits) {}
    [[nodiscard]] std::optional<sim::SuppliedRay> next() override {
        std::optional<sim::SuppliedRay> ray = rays_.next();
        if (ray) hits_.add_ray(ray->ray);
        return ray;
    }
    [[nodiscard]] double share() const override { return rays_.share(); }

  private:
    sim::RaySupply& rays_;
    CheckedHits& hits_;
};

// Simulates the workload that `rays` has come to, checks it when there is a checker, and adds it to the
// report.
void run_workload(WorkloadStream& rays, const model::MemoryImage& image, const RunOptions& options,
                  HitChecker* checker, SceneReport& scene) {
    const std::string name = rays.name();
    CheckedHits hits(name, rays.kind(), checker);
    TeeSupply tee(rays, hits);
    sim::RaySupply& supply = checker != nullptr ? static_cast<sim::RaySupply&>(tee) : rays;
    const double start = cpu_seconds() - rays.cpu_seconds();
    const sim::MachineResult result = sim::simulate(
        options.config, image, supply, rays.kind(),
        [&](const std::optional<model::Hit>& hit) { hits.add_hit(hit); }, options.clock_mode,
        [&](double share) { options.tell(fmt::format("{}: {:.0f} % of all rays", name, share * 100)); });
    // Neither making rays nor checking hits is simulation.
    scene.host.cpu_seconds += cpu_seconds() - rays.cpu_seconds() - hits.cpu_seconds() - start;
    scene.host.simulated_rays += result.ray_count;
    scene.workloads.push_back(workload_report(name, hits.hit_count(), result));
    if (checker == nullptr) return;
    options.tell(name + ": checking hits");
    const model::TraversalCounts counts = hits.finish();
    RTU_CHECK(counts == result.counts,
              "{}: simulated and reference counts differ: {} and {} box tests, {} and {} pair tests", name,
              result.counts.box_tests, counts.box_tests, result.counts.pair_tests, counts.pair_tests);
}

}  // namespace

SceneReport run_scene(const RunOptions& options, const SceneSource& source) {
    const double cpu_start = cpu_seconds();
    const std::unique_ptr<PreparedScene> prepared = prepare_scene(options, source);
    SceneReport& scene = prepared->report;
    const model::TriangleMesh& mesh = prepared->loaded.mesh;
    const model::MemoryImage& image = prepared->built.image;

    std::optional<HitChecker> checker;
    if (options.is_checked) checker.emplace(mesh, image, options.config.rtu.mailbox);
    WorkloadStream rays(make_chunk_source(options, *prepared));
    while (rays.next_workload()) run_workload(rays, image, options, checker ? &*checker : nullptr, scene);
    if (scene.workloads.empty()) throw Error("{}: expected rays, found none", options.rays->file.string());
    if (checker) scene.check = checker->report();
    if (options.wants_pixels) scene.pixels = trace_pixels(mesh, image, scene.camera, scene.resolution);
    scene.host.total_cpu_seconds = cpu_seconds() - cpu_start;
    scene.host.peak_rss_bytes = peak_rss_bytes();
    return std::move(scene);
}

}  // namespace rtu::study
