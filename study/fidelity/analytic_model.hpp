#pragma once

#include <string_view>
#include <vector>

#include "sim/config.hpp"
#include "study/fidelity/workload_profile.hpp"

namespace rtu::study {

/// Cycles that a part of the machine takes for one ray, as seen by one RTU.
struct Demand {
    std::string_view unit;
    double cycles_per_ray = 0;
};

/// What the parts of the machine take for a ray of the block. Units that several RTUs share take the rays of
/// all of them.
[[nodiscard]] std::vector<Demand> demands(const sim::Config& config, const WorkloadProfile& profile,
                                          const ProfileBlock& block);

/// Cycles that a ray spends on its way without waiting for another.
[[nodiscard]] double unloaded_cycles(const sim::Config& config, const ProfileBlock& block);

/// What the analytic model says of a workload.
struct AnalyticResult {
    double cycles_per_ray = 0;  ///< of the whole machine
    double rays = 0;
    std::string_view bottleneck;  ///< the part with the largest demand, over all rays
    double memory_share = 0;      ///< of the cycles, that a cache without misses would save, 0 to 1
    double ends_share = 0;        ///< of the cycles, in which the machine fills or runs empty, 0 to 1
};

/// Every block as a closed queueing network: `rtu.ray_slots` rays go round the parts of an RTU.
[[nodiscard]] AnalyticResult analyse(const sim::Config& config, const WorkloadProfile& profile);

/// Cycles that the hit units of one RTU are held for this work, over all of them; 0 without any.
[[nodiscard]] double hit_unit_cycles(const sim::Config& config, const RayWork& work);

/// Cycles that the whole machine takes for this work at least, by the peak rates of its units alone: those of
/// the busiest one.
[[nodiscard]] double least_cycles(const sim::Config& config, const RayWork& work);

}  // namespace rtu::study
