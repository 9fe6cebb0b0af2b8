// Simulated rays per second of host CPU time: the whole machine with its memory hierarchy, default
// configuration.

#include <benchmark/benchmark.h>

#include "bench_scenes.hpp"
#include "model/workload.hpp"
#include "sim/machine.hpp"

namespace rtu::bench {
namespace {

void simulate_scene(benchmark::State& state, const char* name, model::WorkloadKind kind) {
    const BuiltScene& scene = built_scene(name);
    const model::Workload workload =
        model::make_workload(kind, scene.mesh, scene.image, scene.camera, {256, 256}, 1);
    sim::Cycle cycles = 0;
    while (state.KeepRunning()) {
        cycles = sim::simulate({}, scene.image, workload.rays, workload.ray_kind).cycles;
    }
    const double runs = double(state.iterations());
    using benchmark::Counter;
    state.counters["host_rays_per_second"] = Counter(double(workload.rays.size()) * runs, Counter::kIsRate);
    state.counters["host_cycles_per_second"] = Counter(double(cycles) * runs, Counter::kIsRate);
    state.counters["cycles_per_ray"] = double(cycles) / double(workload.rays.size());
}

const bool is_registered = [] {
    for (const char* name : {"builtin", "bunny", "dragon", "conference", "sponza", "kitchen"}) {
        if (!has_scene(name)) continue;
        for (const model::WorkloadKind kind :
             {model::WorkloadKind::Primary, model::WorkloadKind::Shadow, model::WorkloadKind::Diffuse}) {
            benchmark::RegisterBenchmark(
                ("simulate/" + std::string(name) + "/" + std::string(model::to_string(kind))).c_str(),
                simulate_scene, name, kind)
                ->Unit(benchmark::kMillisecond);
        }
    }
    return true;
}();

}  // namespace
}  // namespace rtu::bench
