// Triangles a second of pair_triangles, by position, on one thread.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <random>
#include <string>
#include <utility>

#include "bench_scenes.hpp"
#include "model/pairing.hpp"

namespace rtu::bench {
namespace {

using namespace rtu::model;

/// A bumpy sheet of 2 n^2 triangles in random order.
TriangleMesh shuffled_sheet(std::uint32_t n) {
    std::mt19937 random(1);
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < (n + 1) * (n + 1); ++i) {
        const std::uint32_t column = i % (n + 1), row = i / (n + 1);
        mesh.positions.push_back({float(column), float(random() % 1000) * 0.001F, float(row)});
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, c = a + n + 1;
            mesh.triangles.push_back({a, a + 1, c + 1});
            mesh.triangles.push_back({a, c + 1, c});
        }
    }
    for (std::size_t i = mesh.triangles.size(); i > 1; --i) {
        std::swap(mesh.triangles[i - 1], mesh.triangles[random() % i]);
    }
    return mesh;
}

void pair_mesh(benchmark::State& state, const TriangleMesh& mesh, PairingMethod method) {
    double paired_percent = 0;
    while (state.KeepRunning()) {
        const Pairing pairing = pair_triangles(mesh, method, EdgeIdentity::Position);
        benchmark::DoNotOptimize(pairing.pairs.data());
        paired_percent = pairing.paired_percent();
    }
    state.counters["paired_percent"] = paired_percent;
    state.counters["triangles_per_second"] =
        benchmark::Counter(double(mesh.triangles.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void pair_sheet(benchmark::State& state, const char* method) {
    pair_mesh(state, shuffled_sheet(512), parse_pairing_method(method));
}

void pair_scene(benchmark::State& state, const char* name, const char* method) {
    if (!has_scene(name)) {
        state.SkipWithError("the scene is not there");
        return;
    }
    pair_mesh(state, load_scene(name), parse_pairing_method(method));
}

BENCHMARK_CAPTURE(pair_sheet, window_2, "window:2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_sheet, edge_bbsa, "edge_bbsa")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_window_2, "bunny", "window:2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_edge_bbsa, "bunny", "edge_bbsa")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_window_2, "dragon", "window:2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_edge_bbsa, "dragon", "edge_bbsa")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rtu::bench
