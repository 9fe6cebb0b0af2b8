#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/memory_image.hpp"
#include "sim/config.hpp"
#include "study/fidelity/functional_walk.hpp"
#include "study/fidelity/ray_population.hpp"

namespace rtu::study {

/// A stretch of a workload: how many of its rays it stands for, and what one of them takes in the mean.
struct ProfileBlock {
    double rays = 0;
    RayWork per_ray;           ///< `per_ray.rays` is 1, or 0 without rays
    double lines_per_ray = 0;  ///< line accesses of nodes and leaves in the L1
    double l1_misses_per_ray = 0;
    double l2_misses_per_ray = 0;      ///< but for first touches
    double first_touches_per_ray = 0;  ///< of a line in the L2
    /// Cycles for which an L1 takes nothing, because more accesses wait for a line on its way than its MSHR
    /// takes; less the time for which what has left it keeps the units busy.
    double held_up_cycles_per_ray = 0;
    double held_up_by_first_touches_per_ray = 0;
};

/// What the analytic model knows of a workload, from a sample of its rays that were traced without a clock.
struct WorkloadProfile {
    std::vector<ProfileBlock> blocks;                           ///< in the order of the rays
    std::array<double, model::max_bvh_width + 1> nodes_with{};  ///< visits of nodes with so many children
    std::uint64_t traced_rays = 0;
};

/// Takes the profile. Work comes from a sparse lattice of rays. Misses come from one dense stretch a block,
/// its rays interleaved as the slots of the RTUs interleave them, by LRU stack distances against the number
/// of lines of each cache; the lattice, and all rays of a row before the stretch, come before it. A line is
/// on its way for as many accesses of its RTU as its unloaded latency has cycles.
[[nodiscard]] WorkloadProfile profile_workload(const sim::Config& config, const model::MemoryImage& image,
                                               const RayPopulation& population, std::uint64_t seed);

}  // namespace rtu::study
