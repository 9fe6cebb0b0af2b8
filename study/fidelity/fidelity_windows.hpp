#pragma once

#include <cstdint>
#include <vector>

#include "sim/config.hpp"
#include "sim/machine.hpp"
#include "study/fidelity/functional_walk.hpp"
#include "study/fidelity/ray_population.hpp"

// Systematic samples of a run, after SMARTS [WWFH03]: one machine simulates short windows of consecutive
// rays, each at random in its equal share of the workload; what lies between them is skipped, but for a
// sparse lattice of rays whose traversal without a clock keeps the caches warm and tells the work of the
// whole workload.

namespace rtu::study {

/// Where to measure. All lengths are positions of the population, unless they say rays.
struct WindowPlan {
    std::uint32_t stratum_count = 24;    ///< equal shares of the workload, with a window each
    std::vector<std::uint32_t> taken{};  ///< where windows lie already: their strata get no other
    /// Whether the first and the last window and the blocks are measured too: once is enough for them.
    bool has_ends_and_blocks = true;
    std::uint32_t window_length = 512;
    std::uint32_t settling_rays = 256;  ///< simulated before each window, not measured
    std::uint32_t warm_length = 2048;   ///< before each window, all traced to warm the caches
    std::uint32_t lattice_stride = 64;  ///< of each so many positions one is traced
    /// As many rays as are in the machine together, so that its busiest unit sets their pace; a window has
    /// whole blocks.
    std::uint32_t block_length = 128;
    std::uint32_t block_stride = 4096;  ///< of each so many positions a block is traced
    std::uint64_t seed = 1;             ///< of the places of windows, lattice and blocks
    bool has_image_in_l2 = false;       ///< from the start, so that DRAM is never asked
};

/// Rays traced without a clock.
struct TracedWork {
    RayWork work;
    double least_cycles = 0;        ///< of the blocks that they make, one after another: see least_cycles()
    double least_cycles_alone = 0;  ///< the same were every ray a block
};

/// Cycles and work of a stretch of a run.
struct WindowSample {
    double cycles = 0;
    RayWork work;         ///< that the machine did meanwhile: rays, nodes, boxes, leaves, pairs, triangles
    TracedWork traced{};  ///< of the rays that it was handed meanwhile; windows of the middle only
    std::uint32_t begin = 0;  ///< position
};

/// What was measured. The population is the first window (from cold caches), the last one (until its last ray
/// has returned) and `middle_length` positions between them.
struct WindowMeasurement {
    WindowSample first, last;           ///< see WindowPlan::has_ends_and_blocks
    std::vector<WindowSample> windows;  ///< of the middle
    std::vector<RayWork> lattice;       ///< of one position each, spread over the middle
    std::vector<TracedWork> blocks;     ///< of `block_length` each, likewise; see there too
    std::uint32_t window_length = 0;
    std::uint32_t block_length = 0;
    std::uint64_t middle_length = 0;
    std::uint64_t simulated_rays = 0;
    std::uint64_t traced_rays = 0;  ///< without a clock
};

/// Positions that a plan looks at with the clock; some more where two windows of earlier plans share a
/// stratum.
[[nodiscard]] std::uint64_t simulated_length(const WindowPlan& plan);

/// Measures. The windows, with the rays before them, must fit into the population: see simulated_length().
[[nodiscard]] WindowMeasurement measure_windows(const sim::Config& config, const model::MemoryImage& image,
                                                const RayPopulation& population, const WindowPlan& plan);

}  // namespace rtu::study
