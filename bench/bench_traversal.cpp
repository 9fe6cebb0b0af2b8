// Functional traversal against Embree's single-ray query: same rays, same scene, one thread, one run.

#include <benchmark/benchmark.h>

#include "bench_scenes.hpp"
#include "model/camera.hpp"
#include "model/traversal.hpp"
#include "model/workload.hpp"
#include "study/oracle/embree_oracle.hpp"

namespace rtu::bench {
namespace {

constexpr model::Resolution resolution{512, 512};

std::vector<model::Ray> rays_of(const BuiltScene& scene, model::WorkloadKind kind) {
    return model::make_workload(kind, scene.mesh, scene.image, scene.camera, resolution, 1).rays;
}

void report_rate(benchmark::State& state, std::size_t rays) {
    state.counters["rays_per_second"] =
        benchmark::Counter(double(rays) * double(state.iterations()), benchmark::Counter::kIsRate);
}

void trace_reference(benchmark::State& state, const char* name, model::WorkloadKind kind) {
    const BuiltScene& scene = built_scene(name);
    const auto rays = rays_of(scene, kind);
    model::TraversalStack scratch;
    while (state.KeepRunning()) {
        for (const model::Ray& ray : rays) {
            benchmark::DoNotOptimize(model::trace(scratch, scene.image, ray, model::RayKind::ClosestHit));
        }
    }
    report_rate(state, rays.size());
}

void trace_embree(benchmark::State& state, const char* name, model::WorkloadKind kind) {
    const BuiltScene& scene = built_scene(name);
    const auto rays = rays_of(scene, kind);
    const study::EmbreeOracle embree(scene.mesh);
    while (state.KeepRunning()) {
        for (const model::Ray& ray : rays) {
            benchmark::DoNotOptimize(embree.trace(ray, model::RayKind::ClosestHit));
        }
    }
    report_rate(state, rays.size());
}

const bool is_registered = [] {
    for (const char* name : {"builtin", "bunny", "conference", "kitchen"}) {
        if (!has_scene(name)) continue;
        for (const model::WorkloadKind kind : {model::WorkloadKind::Primary, model::WorkloadKind::Diffuse}) {
            const std::string suffix = std::string(name) + "/" + std::string(model::to_string(kind));
            benchmark::RegisterBenchmark(("trace/reference/" + suffix).c_str(), trace_reference, name, kind)
                ->Unit(benchmark::kMillisecond);
            benchmark::RegisterBenchmark(("trace/embree/" + suffix).c_str(), trace_embree, name, kind)
                ->Unit(benchmark::kMillisecond);
        }
    }
    return true;
}();

}  // namespace
}  // namespace rtu::bench
