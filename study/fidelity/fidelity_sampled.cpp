#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/cpu_time.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/fidelity/fidelity_windows.hpp"

namespace rtu::study {
namespace {

// Share of the positions that have a ray.
double density(const RayPopulation& population) {
    constexpr std::uint32_t wanted = 1024;
    const std::uint32_t count = std::min(population.size(), wanted);
    std::vector<std::uint32_t> positions(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        positions[i] =
            std::uint32_t((std::uint64_t(2) * i + 1) * population.size() / (std::uint64_t(2) * count));
    }
    return double(population.part(positions).rays.size()) / count;
}

// Windows of four to eight times the rays in flight, so that the mix of two places at their ends weighs
// little, after as many as let those of another place leave.
WindowPlan first_plan(const sim::Config& config, const RayPopulation& population, std::uint64_t seed) {
    const std::uint32_t in_flight = config.rtu.ray_slots * config.rtu.count;
    const std::uint32_t settled = std::max(64U, 4 * in_flight);
    const double positions_per_ray = 1 / std::max(density(population), 1.0 / 16);
    const auto positions = [&](double rays) { return std::uint32_t(std::lround(rays * positions_per_ray)); };
    WindowPlan plan;
    plan.block_length = std::max(16U, in_flight / 8);
    const std::uint32_t length = positions(std::clamp(population.size() / 1024, settled, 2 * settled));
    plan.window_length = (length + plan.block_length - 1) / plan.block_length * plan.block_length;
    plan.settling_rays = settled;
    plan.warm_length = population.row_length() + positions(settled);
    plan.lattice_stride = std::clamp(population.size() / 32768, 8U, 64U);
    plan.block_stride = 2 * plan.lattice_stride * plan.block_length;
    plan.seed = seed;
    return plan;
}

// Of the estimate, for what the samples do not tell: lines that skipped rays would have left in the caches,
// and long rays under way that settling did not bring. Measured, see docs/fidelity.md. It is as likely to one
// side as to the other and has nothing to do with the windows' scatter, so the two add as their squares do.
constexpr double bias_allowance = 0.005;

class Sampling {
  public:
    Sampling(const sim::Config& config, const model::MemoryImage& image, const RayPopulation& population,
             const SampledOptions& options)
        : config_(config),
          image_(image),
          population_(population),
          options_(options),
          plan_(first_plan(config, population, options.seed)) {
        plan_.has_image_in_l2 = options.dram_allowance.has_value();
    }

    LevelResult run() {
        const double start = cpu_seconds();
        while (!is_precise()) {
            if (!is_worth_while()) {
                LevelResult all = run_cycle(config_, image_, population_);
                all.cpu_seconds = cpu_seconds() - start;
                all.account = "every ray: enough samples would be too large a part of them";
                return all;
            }
            take_pass();
            plan_next_pass();
        }
        result_.estimate = widened(result_.estimate, bias_allowance, dram_allowance());
        result_.level = "sampled";
        result_.account =
            fmt::format("{} windows of {} positions in {} {}, every {}th ray traced between them",
                        plan_.taken.size(), plan_.window_length, passes_.size(),
                        passes_.size() == 1 ? "pass" : "passes", plan_.lattice_stride);
        result_.cpu_seconds = cpu_seconds() - start;
        return std::move(result_);
    }

  private:
    [[nodiscard]] double dram_allowance() const { return options_.dram_allowance.value_or(0); }
    [[nodiscard]] double wanted_half_width() const {
        const double all = options_.tolerance - dram_allowance();
        return std::sqrt(std::max(0.0, all * all - bias_allowance * bias_allowance));
    }
    [[nodiscard]] bool is_precise() const {
        return !passes_.empty() && result_.estimate.relative_half_width() <= wanted_half_width();
    }

    // Samples cost little more than their share of the rays, but are in vain when every ray follows.
    [[nodiscard]] bool is_worth_while() const {
        const double next = double(simulated_length_ + simulated_length(plan_)) / population_.size();
        return next <= (passes_.empty() ? 1 : 1.5) * options_.most_in_first_pass;
    }

    void take_pass() {
        simulated_length_ += simulated_length(plan_);
        passes_.push_back(measure_windows(config_, image_, population_, plan_));
        result_.simulated_rays += passes_.back().simulated_rays;
        result_.traced_rays += passes_.back().traced_rays;
        result_.estimate = estimate_cycles(config_, passes_);
    }

    // New, smaller shares, of which those without a window get one: all together are one sample. The interval
    // shrinks with the root of the number of windows, and more where neighbours are alike.
    void plan_next_pass() {
        for (const WindowSample& window : passes_.back().windows) plan_.taken.push_back(window.begin);
        const double ratio = result_.estimate.relative_half_width() / std::max(wanted_half_width(), 1e-6);
        const double growth = std::clamp(1.1 * ratio * ratio, 1.5, 16.0);
        plan_.stratum_count =
            std::min(population_.size(), std::uint32_t(growth * double(plan_.taken.size())));
        plan_.has_ends_and_blocks = false;
        ++plan_.seed;
    }

    const sim::Config& config_;
    const model::MemoryImage& image_;
    const RayPopulation& population_;
    SampledOptions options_;
    WindowPlan plan_;
    std::vector<WindowMeasurement> passes_;
    std::uint64_t simulated_length_ = 0;
    LevelResult result_;
};

}  // namespace

bool has_small_first_pass(const sim::Config& config, const RayPopulation& population,
                          const SampledOptions& options) {
    const std::uint64_t length = simulated_length(first_plan(config, population, options.seed));
    return double(length) <= options.most_in_first_pass * population.size();
}

LevelResult run_sampled(const sim::Config& config, const model::MemoryImage& image,
                        const RayPopulation& population, const SampledOptions& options) {
    return Sampling(config, image, population, options).run();
}

}  // namespace rtu::study
