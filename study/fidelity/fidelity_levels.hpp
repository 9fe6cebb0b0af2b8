#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/config.hpp"
#include "study/fidelity/fidelity_estimate.hpp"
#include "study/fidelity/ray_population.hpp"

// The ways of telling a workload's MRPS, each as a function of machine, image and rays.

namespace rtu::study {

/// What a level of fidelity says of a workload, and what that took.
struct LevelResult {
    CycleEstimate estimate;
    std::uint64_t simulated_rays = 0;  ///< with the clock
    std::uint64_t traced_rays = 0;     ///< without
    double cpu_seconds = 0;            ///< of the host, ray generation included
    std::string level;                 ///< the one that the estimate is from
    std::string account;               ///< one line on what was modelled and how
};

enum class FidelityLevel : std::uint8_t { Counts, Analytic, Sampled, Cycle, Rtl, Auto };

/// Of counts, analytic, sampled, cycle, rtl and auto; throws Error, telling these, for others.
[[nodiscard]] FidelityLevel parse_fidelity_level(std::string_view name);
[[nodiscard]] std::string_view to_string(FidelityLevel level);

struct SampledOptions {
    double tolerance = 0.02;  ///< half the 95 % interval over the estimate
    std::uint64_t seed = 1;
    double most_in_first_pass = 1.0 / 3;  ///< of the rays: a first pass of more is not tried
    /// Set where DRAM is to be left out: the whole image is in the L2 from the start, and a run takes so much
    /// longer at most, relative.
    std::optional<double> dram_allowance{};
};

/// Every ray traced without a clock: exact counts, and the MRPS of the peak rates, which no run exceeds. The
/// interval reaches from there to no end.
[[nodiscard]] LevelResult run_counts(const sim::Config& config, const model::MemoryImage& image,
                                     const RayPopulation& population);

/// The analytic model of a sampled profile. Its interval is an allowance for the model's errors:
/// docs/fidelity.md tells where it is from.
[[nodiscard]] LevelResult run_analytic(const sim::Config& config, const model::MemoryImage& image,
                                       const RayPopulation& population, std::uint64_t seed);

/// Every ray through the cycle model, from cold caches: exact, so the interval has no width.
[[nodiscard]] LevelResult run_cycle(const sim::Config& config, const model::MemoryImage& image,
                                    const RayPopulation& population);

/// Every ray through the Verilated RTU, which runs at some thousand rays a second. Throws Error for more than
/// 65,536 positions, for a machine that is not that of the RTL, and without Verilator.
[[nodiscard]] LevelResult run_rtl(const sim::Config& config, const model::MemoryImage& image,
                                  const RayPopulation& population);

/// Systematic samples until the interval, bias allowance included, meets the tolerance; every ray when that
/// would take more than half of them. docs/fidelity.md tells the method.
[[nodiscard]] LevelResult run_sampled(const sim::Config& config, const model::MemoryImage& image,
                                      const RayPopulation& population, const SampledOptions& options);

/// Whether sampled would begin with a pass, or go to every ray at once.
[[nodiscard]] bool has_small_first_pass(const sim::Config& config, const RayPopulation& population,
                                        const SampledOptions& options);

/// The cheapest of analytic, sampled and cycle whose bound is within the tolerance; without DRAM where the
/// image fits the L2 and the bound allows it. The account says which, what is left out, and why.
[[nodiscard]] LevelResult run_auto(const sim::Config& config, const model::MemoryImage& image,
                                   const RayPopulation& population, SampledOptions options);

[[nodiscard]] LevelResult run_level(FidelityLevel level, const sim::Config& config,
                                    const model::MemoryImage& image, const RayPopulation& population,
                                    const SampledOptions& options);

}  // namespace rtu::study
