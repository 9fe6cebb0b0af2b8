// The slab test with an interval that starts at the ray's t_min, and with one that starts at zero: what
// leaving t_min out of a box test gains, as [EP18] (docs/methods.md) reports 1 % of a path tracer's time.

#include <benchmark/benchmark.h>

#include <limits>

#include "model/random.hpp"
#include "model/slab_test.hpp"

namespace rtu::bench {
namespace {

constexpr std::uint32_t width = 4, node_count = 256, ray_count = 256;

model::Vec3 point(model::RandomStream& random) {
    const float x = random.next(), y = random.next(), z = random.next();
    return {x, y, z};
}

std::vector<model::Node<width>> random_nodes() {
    std::vector<model::Node<width>> nodes(node_count);
    for (std::uint32_t i = 0; i < node_count; ++i) {
        nodes[i].child_count = width;
        for (std::uint32_t child = 0; child < width; ++child) {
            model::RandomStream random(1, child, i);
            model::Aabb box;
            box.extend(point(random));
            box.extend(point(random));
            nodes[i].set_box(child, box);
        }
    }
    return nodes;
}

std::vector<model::RaySetup> random_rays() {
    std::vector<model::RaySetup> rays;
    for (std::uint32_t i = 0; i < ray_count; ++i) {
        model::RandomStream random(2, 0, i);
        const model::Vec3 origin = point(random);
        const model::Ray ray{origin, 0.01F, point(random) - origin, std::numeric_limits<float>::infinity()};
        rays.push_back(make_ray_setup(ray, {{0, 0, 0}, {1, 1, 1}}));
    }
    return rays;
}

template <bool HasTMin>
void slab(benchmark::State& state) {
    const auto nodes = random_nodes();
    const auto rays = random_rays();
    while (state.KeepRunning()) {
        for (const model::RaySetup& setup : rays) {
            model::SlabRay<width> ray(setup);
            if constexpr (!HasTMin) ray.t_min = model::all_lanes<width>(0.0F);
            for (const auto& node : nodes) {
                auto hits = model::slab_test(node, ray, setup.t_max);
                benchmark::DoNotOptimize(hits);
            }
        }
    }
    state.counters["box_tests_per_second"] = benchmark::Counter(
        double(ray_count) * node_count * width * double(state.iterations()), benchmark::Counter::kIsRate);
}

BENCHMARK(slab<true>)->Name("slab_test/with_t_min");
BENCHMARK(slab<false>)->Name("slab_test/without_t_min");

}  // namespace
}  // namespace rtu::bench
