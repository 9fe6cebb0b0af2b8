#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/traversal.hpp"
#include "study/cpu_time.hpp"
#include "study/fidelity/analytic_model.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/fidelity/unloaded_latency.hpp"

// The levels that simulate no cycle, and the choice between all.

namespace rtu::study {
namespace {

// Of the analytic model's estimate; measured, see docs/fidelity.md.
constexpr double always_allowed = 0.06, allowed_of_memory = 0.9;

double analytic_allowance(const AnalyticResult& result) {
    return always_allowed + allowed_of_memory * result.memory_share + result.ends_share;
}

// Of the rays: a first pass of more is not worth its risk, that every ray follows.
constexpr double most_of_auto = 1.0 / 9;

// What first touches cost at most, of the cycles of a run: every line of the image fetched alone, all else
// waiting.
double first_touch_allowance(const sim::Config& config, const model::MemoryImage& image,
                             const AnalyticResult& found) {
    const double lines = std::ceil(double(image.size_bytes()) / config.l2.line_bytes);
    return lines * dram_cycles(config) / (found.rays * found.cycles_per_ray);
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
        const std::uint32_t end = begin + std::min(RayPopulation::part_positions, population.size() - begin);
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
        result.estimate.cycles_per_ray = least_cycles(config, all) / result.estimate.rays;
        result.estimate.low = result.estimate.cycles_per_ray;
        result.estimate.high = std::numeric_limits<double>::infinity();
    }
    result.cpu_seconds = cpu_seconds() - start;
    return result;
}

namespace {

// What the analytic model says, and why.
struct Analysis {
    LevelResult result;
    AnalyticResult found;
};

Analysis analyse_workload(const sim::Config& config, const model::MemoryImage& image,
                          const RayPopulation& population, std::uint64_t seed) {
    const double start = cpu_seconds();
    const WorkloadProfile profile = profile_workload(config, image, population, seed);
    const AnalyticResult found = analyse(config, profile);
    LevelResult result;
    const double allowance = analytic_allowance(found);
    // So few rays never come to the steady state that the model describes: nothing bounds its error but the
    // peak rates.
    const bool is_steady = found.rays >= 64.0 * config.rtu.ray_slots * config.rtu.count;
    result.estimate = {found.cycles_per_ray, found.cycles_per_ray * std::max(0.0, 1 - allowance),
                       found.cycles_per_ray * (1 + allowance), found.rays};
    if (!is_steady) {
        result.estimate.low = std::min(found.cycles_per_ray, least_cycles(config, mean_work(profile)));
        result.estimate.high = std::numeric_limits<double>::infinity();
    }
    result.traced_rays = profile.traced_rays;
    result.level = "analytic";
    result.account = fmt::format("queueing model: limited by {}, misses take {:.0f} % of the cycles",
                                 found.bottleneck, 100 * found.memory_share);
    result.cpu_seconds = cpu_seconds() - start;
    return {result, found};
}

bool fits_l2(const sim::Config& config, const model::MemoryImage& image) {
    return config.memory.model != sim::MemoryModel::Flat && image.size_bytes() <= config.l2.size_bytes;
}

// `sampled`, or every ray; without DRAM where that changes less than a quarter of the tolerance.
LevelResult simulate_for_auto(const sim::Config& config, const model::MemoryImage& image,
                              const RayPopulation& population, SampledOptions options,
                              const AnalyticResult& found) {
    const double touches = first_touch_allowance(config, image, found);
    if (fits_l2(config, image) && touches <= options.tolerance / 4) options.dram_allowance = touches;
    LevelResult result = run_sampled(config, image, population, options);
    if (options.dram_allowance && result.level == "sampled") {
        result.account +=
            fmt::format("; no DRAM: the image of {:.1f} MiB fits the L2, first touches cost {:.2f} % at most",
                        double(image.size_bytes()) / (1 << 20), 100 * touches);
    }
    return result;
}

}  // namespace

LevelResult run_analytic(const sim::Config& config, const model::MemoryImage& image,
                         const RayPopulation& population, std::uint64_t seed) {
    return analyse_workload(config, image, population, seed).result;
}

LevelResult run_auto(const sim::Config& config, const model::MemoryImage& image,
                     const RayPopulation& population, SampledOptions options) {
    options.most_in_first_pass = most_of_auto;
    const bool may_be_analytic = options.tolerance >= always_allowed;
    const std::string unsure = fmt::format("analytic is never surer than {:.0f} %", 100 * always_allowed);
    if (!may_be_analytic && !has_small_first_pass(config, population, options)) {
        LevelResult result = run_cycle(config, image, population);
        result.account =
            fmt::format("cycle: {}; too few rays to gain by samples, and {}", result.account, unsure);
        return result;
    }
    // It also tells what DRAM costs, which may be left out only where the image fits the L2.
    if (!may_be_analytic && !fits_l2(config, image)) {
        LevelResult result = run_sampled(config, image, population, options);
        result.account = fmt::format("{}: {}; {}", result.level, result.account, unsure);
        return result;
    }
    const auto [analytic, found] = analyse_workload(config, image, population, options.seed);
    const double bound = analytic.estimate.relative_half_width();
    LevelResult result = analytic;
    if (!(bound <= options.tolerance)) {
        result = simulate_for_auto(config, image, population, options, found);
        result.cpu_seconds += analytic.cpu_seconds;
        result.traced_rays += analytic.traced_rays;
    }
    const std::string stated = std::isfinite(bound) ? fmt::format("{:.1f} % off at most", 100 * bound)
                                                    : std::string("too few rays for a bound");
    result.account =
        fmt::format("{}: {}; analytic: {}, {}", result.level, result.account, stated, analytic.account);
    return result;
}

}  // namespace rtu::study
