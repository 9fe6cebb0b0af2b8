#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/cpu_time.hpp"
#include "study/fidelity/fidelity_levels.hpp"

namespace rtu::study {
namespace {

// Share of the positions that have a ray.
double density(const RayPopulation& population) {
    constexpr std::uint32_t wanted = 1024;
    const std::uint32_t count = std::min(population.size(), wanted);
    std::vector<std::uint32_t> positions(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        positions[i] = std::uint32_t((std::uint64_t(2) * i + 1) * population.size() / (2 * count));
    }
    return double(population.part(positions).rays.size()) / count;
}

// Windows of four to eight times the rays in flight, so that the mix of two places at their ends weighs
// little, after as many as let those of another place leave.
WindowPlan first_plan(const sim::Config& config, const RayPopulation& population, std::uint64_t seed) {
    const std::uint32_t settled = std::max(64U, 4 * config.rtu.ray_slots * config.rtu.count);
    const double positions_per_ray = 1 / std::max(density(population), 1.0 / 16);
    const auto positions = [&](double rays) { return std::uint32_t(std::lround(rays * positions_per_ray)); };
    WindowPlan plan;
    plan.window_count = 16;
    plan.window_length = positions(std::clamp(population.size() / 1024, settled, 2 * settled));
    plan.settling_rays = settled;
    plan.warm_length = population.row_length() + positions(settled);
    plan.lattice_stride = std::clamp(population.size() / 32768, 8U, 64U);
    plan.seed = seed;
    return plan;
}

// Of the estimate, for what the samples do not tell: lines that skipped rays would have left in the caches,
// and long rays under way that settling did not bring. Measured, see docs/fidelity.md.
constexpr double bias_allowance = 0.005;

class Sampling {
  public:
    Sampling(const sim::Config& config, const model::MemoryImage& image, const RayPopulation& population,
             const SampledOptions& options)
        : config_(config),
          image_(image),
          population_(population),
          options_(options),
          plan_(first_plan(config, population, options.seed)) {}

    LevelResult run() {
        const double start = cpu_seconds();
        while (!is_precise()) {
            simulated_length_ += simulated_length(plan_);
            if (3 * simulated_length_ > population_.size()) {
                LevelResult all = run_cycle(config_, image_, population_);
                all.cpu_seconds = cpu_seconds() - start;
                all.account = fmt::format("every ray: enough samples would be more than a third of them");
                return all;
            }
            take_pass();
            plan_next_pass();
        }
        const double allowance = bias_allowance * result_.estimate.cycles_per_ray;
        result_.estimate.low -= allowance;
        result_.estimate.high += allowance;
        result_.level = "sampled";
        result_.account =
            fmt::format("{} windows of {} positions in {} {}, every {}th ray traced between them",
                        window_count_, plan_.window_length, passes_.size(),
                        passes_.size() == 1 ? "pass" : "passes", plan_.lattice_stride);
        result_.cpu_seconds = cpu_seconds() - start;
        return std::move(result_);
    }

  private:
    [[nodiscard]] double wanted_half_width() const { return options_.tolerance - bias_allowance; }
    [[nodiscard]] bool is_precise() const {
        return !passes_.empty() && result_.estimate.relative_half_width() <= wanted_half_width();
    }

    void take_pass() {
        passes_.push_back(measure_windows(config_, image_, population_, plan_));
        window_count_ += plan_.window_count;
        result_.simulated_rays += passes_.back().simulated_rays;
        result_.traced_rays += passes_.back().traced_rays;
        result_.estimate = estimate_cycles(config_, passes_);
    }

    // The interval shrinks with the root of the number of windows; some more, because its width is a guess
    // too.
    void plan_next_pass() {
        constexpr double margin = 1.1, most = 1e6;
        const double ratio = result_.estimate.relative_half_width() / std::max(wanted_half_width(), 1e-6);
        const double more = window_count_ * (margin * ratio * ratio - 1);
        plan_.window_count = std::uint32_t(std::clamp(more, 8.0, most));
        ++plan_.seed;
    }

    const sim::Config& config_;
    const model::MemoryImage& image_;
    const RayPopulation& population_;
    SampledOptions options_;
    WindowPlan plan_;
    std::vector<WindowMeasurement> passes_;
    double window_count_ = 0;
    std::uint64_t simulated_length_ = 0;
    LevelResult result_;
};

}  // namespace

LevelResult run_sampled(const sim::Config& config, const model::MemoryImage& image,
                        const RayPopulation& population, const SampledOptions& options) {
    return Sampling(config, image, population, options).run();
}

}  // namespace rtu::study
