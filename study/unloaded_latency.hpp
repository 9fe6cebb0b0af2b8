#pragma once

#include "sim/config.hpp"

// What the steps of a ray's way take when nothing else is in the way: docs/machine.md.

namespace rtu::study {

/// More for a line that misses the L1 and is found in the L2.
[[nodiscard]] inline double l2_cycles(const sim::Config& config) { return config.l2.latency_cycles + 2.0; }

/// More for a line that misses the L2, with another row open, as mostly.
[[nodiscard]] inline double dram_cycles(const sim::Config& config) {
    const auto& dram = config.dram;
    const std::uint32_t bus_cycles = (config.l2.line_bytes + dram.bytes_per_cycle - 1) / dram.bytes_per_cycle;
    return dram.t_rp_cycles + dram.t_rcd_cycles + dram.t_cas_cycles + bus_cycles + dram.latency_cycles + 2.0;
}

}  // namespace rtu::study
