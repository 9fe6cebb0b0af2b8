#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/traversal.hpp"
#include "study/cpu_time.hpp"
#include "study/fidelity/analytic_model.hpp"
#include "study/fidelity/fidelity_levels.hpp"

// The levels that simulate no cycle, and the choice between all.

namespace rtu::study {
namespace {

constexpr std::uint32_t part_positions = 1 << 16;

// Of the analytic model's estimate; measured, see docs/fidelity.md.
double analytic_allowance(const AnalyticResult& result) {
    constexpr double always = 0.06, of_memory = 0.9;
    return always + of_memory * result.memory_share + result.ends_share;
}

RayWork mean_work(const WorkloadProfile& profile) {
    RayWork sum;
    double rays = 0;
    for (const ProfileBlock& block : profile.blocks) {
        sum += block.rays * block.per_ray;
        rays += block.rays;
    }
    return rays > 0 ? 1 / rays * sum : sum;
}

}  // namespace

LevelResult run_counts(const sim::Config& config, const model::MemoryImage& image,
                       const RayPopulation& population) {
    const double start = cpu_seconds();
    model::TraversalCounts counts;
    model::TraversalStack stack;
    LevelResult result;
    for (std::uint32_t begin = 0; begin < population.size();) {
        const std::uint32_t end = begin + std::min(part_positions, population.size() - begin);
        const PopulationPart part = population.part(begin, end);
        for (const model::Ray& ray : part.rays) {
            static_cast<void>(model::trace(stack, image, ray, population.kind(), &counts));
        }
        result.traced_rays += part.rays.size();
        begin = end;
    }
    result.level = "counts";
    result.account = "every ray without a clock; peak rates of host, box and pair units";
    result.estimate.rays = double(result.traced_rays);
    if (result.traced_rays > 0) {
        const RayWork all{result.estimate.rays,      double(counts.node_visits),
                          double(counts.box_tests),  double(counts.pair_tests),
                          double(counts.pair_tests), double(counts.triangle_tests)};
        result.estimate.cycles_per_ray = least_cycles_per_ray(config, 1 / result.estimate.rays * all);
        result.estimate.low = result.estimate.cycles_per_ray;
        result.estimate.high = std::numeric_limits<double>::infinity();
    }
    result.cpu_seconds = cpu_seconds() - start;
    return result;
}

LevelResult run_analytic(const sim::Config& config, const model::MemoryImage& image,
                         const RayPopulation& population, std::uint64_t seed) {
    const double start = cpu_seconds();
    const WorkloadProfile profile = profile_workload(config, image, population, seed);
    const AnalyticResult found = analyse(config, profile);
    LevelResult result;
    const double allowance = analytic_allowance(found);
    // So few rays never come to the steady state that the model describes: nothing bounds its error but the
    // peak rates.
    const bool is_steady = found.rays >= 16.0 * config.rtu.ray_slots * config.rtu.count;
    result.estimate = {found.cycles_per_ray, found.cycles_per_ray * std::max(0.0, 1 - allowance),
                       found.cycles_per_ray * (1 + allowance), found.rays};
    if (!is_steady) {
        result.estimate.low =
            std::min(found.cycles_per_ray, least_cycles_per_ray(config, mean_work(profile)));
        result.estimate.high = std::numeric_limits<double>::infinity();
    }
    result.traced_rays = profile.traced_rays;
    result.level = "analytic";
    result.account = fmt::format("queueing model: limited by {}, misses take {:.0f} % of the cycles",
                                 found.bottleneck, 100 * found.memory_share);
    result.cpu_seconds = cpu_seconds() - start;
    return result;
}

LevelResult run_auto(const sim::Config& config, const model::MemoryImage& image,
                     const RayPopulation& population, const SampledOptions& options) {
    const LevelResult analytic = run_analytic(config, image, population, options.seed);
    LevelResult result = analytic;
    if (analytic.estimate.relative_half_width() > options.tolerance) {
        result = run_sampled(config, image, population, options);
        result.cpu_seconds += analytic.cpu_seconds;
        result.traced_rays += analytic.traced_rays;
    }
    const double bound = analytic.estimate.relative_half_width();
    const std::string stated = std::isfinite(bound) ? fmt::format("{:.1f} % off at most", 100 * bound)
                                                    : std::string("too few rays for a bound");
    result.account =
        fmt::format("{}: {}; analytic: {}, {}", result.level, result.account, stated, analytic.account);
    return result;
}

}  // namespace rtu::study
