// Triangles a second of pair_triangles, by position, and its sort against the standard library's.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench_scenes.hpp"
#include "model/edge_bbsa.hpp"
#include "model/pair_candidates.hpp"
#include "model/pairing.hpp"
#include "model/radix_sort.hpp"
#include "model/weld.hpp"

namespace rtu::bench {
namespace {

using namespace rtu::model;

/// A bumpy sheet of 2 n^2 triangles, row by row.
TriangleMesh sheet(std::uint32_t n) {
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
    return mesh;
}

TriangleMesh shuffled_sheet(std::uint32_t n) {
    std::mt19937 random(2);
    TriangleMesh mesh = sheet(n);
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

void pair_scene_on_threads(benchmark::State& state, const char* name, const char* method) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    std::size_t(state.range(0)));
    pair_scene(state, name, method);
}

/// Time per triangle from 10 k to 10 M triangles; the sheet's triangles in file order, so that only the
/// amount of memory changes.
void pair_size(benchmark::State& state, const char* method) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    std::size_t(state.range(1)));
    pair_mesh(state, sheet(std::uint32_t(state.range(0))), parse_pairing_method(method));
}

/// The candidates of a scene before they are sorted.
std::vector<PairCandidate> unsorted_candidates(const TriangleMesh& mesh) {
    ScratchMemory memory(mesh.triangles.size() * 256 + mesh.positions.size() * 64 + 4096);
    const IdentifiedMesh identified{mesh.triangles, mesh.positions, weld_positions(mesh.positions, memory)};
    const auto area_of = [&mesh](std::uint32_t lower, std::uint32_t upper, HalfEdge, HalfEdge) {
        return edge_box_area(mesh.positions[lower], mesh.positions[upper]);
    };
    const auto sorted = sorted_candidates(identified, memory, area_of);
    std::vector<PairCandidate> candidates(sorted.begin(), sorted.end());
    std::ranges::sort(candidates, {}, [](const PairCandidate& c) { return c.first.index; });
    return candidates;
}

template <class Sort>
void sort_candidates(benchmark::State& state, const char* name, Sort sort) {
    if (!has_scene(name)) {
        state.SkipWithError("the scene is not there");
        return;
    }
    const std::vector<PairCandidate> unsorted = unsorted_candidates(load_scene(name));
    std::vector<PairCandidate> items(unsorted.size()), scratch(unsorted.size());
    while (state.KeepRunning()) {
        state.PauseTiming();
        items = unsorted;
        state.ResumeTiming();
        sort(std::span(items), std::span(scratch));
        benchmark::DoNotOptimize(items.data());
    }
}

constexpr auto rank_of = [](const PairCandidate& c) { return c.rank; };
constexpr auto by_radix = [](std::span<PairCandidate> items, std::span<PairCandidate> scratch) {
    radix_sort(items, scratch, rank_of);
};
constexpr auto by_std_sort = [](std::span<PairCandidate> items, std::span<PairCandidate>) {
    std::ranges::sort(items, {}, rank_of);
};
constexpr auto by_std_stable_sort = [](std::span<PairCandidate> items, std::span<PairCandidate>) {
    std::ranges::stable_sort(items, {}, rank_of);
};

BENCHMARK_CAPTURE(pair_sheet, window_2, "window:2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_sheet, edge_bbsa, "edge_bbsa")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_sheet, sa_exchange, "sa_exchange")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_window_2, "bunny", "window:2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_edge_bbsa, "bunny", "edge_bbsa")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_edge_bbsa_compressed, "bunny", "edge_bbsa_compressed")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_sa_exchange, "bunny", "sa_exchange")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_sa_saving, "bunny", "sa_saving")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, bunny_maximum, "bunny", "maximum")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_window_2, "dragon", "window:2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_edge_bbsa, "dragon", "edge_bbsa")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_edge_bbsa_compressed, "dragon", "edge_bbsa_compressed")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_sa_exchange, "dragon", "sa_exchange")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_sa_saving, "dragon", "sa_saving")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene, dragon_maximum, "dragon", "maximum")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene_on_threads, bunny_edge_bbsa, "bunny", "edge_bbsa")
    ->DenseRange(1, 2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pair_scene_on_threads, dragon_edge_bbsa, "dragon", "edge_bbsa")
    ->DenseRange(1, 2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
// 2 n^2 triangles on so many threads.
BENCHMARK_CAPTURE(pair_size, edge_bbsa, "edge_bbsa")
    ->ArgsProduct({{71, 224, 707, 2236}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sort_candidates, bunny_radix, "bunny", by_radix)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sort_candidates, bunny_std_sort, "bunny", by_std_sort)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sort_candidates, bunny_std_stable_sort, "bunny", by_std_stable_sort)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sort_candidates, dragon_radix, "dragon", by_radix)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sort_candidates, dragon_std_sort, "dragon", by_std_sort)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sort_candidates, dragon_std_stable_sort, "dragon", by_std_stable_sort)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rtu::bench
