#pragma once

#include "sim/config.hpp"

// What the steps of a ray's way take when nothing else is in the way: docs/machine.md.

namespace rtu::study {

[[nodiscard]] inline bool has_flat_memory(const sim::Config& config) {
    return config.memory.model == sim::MemoryModel::Flat;
}

/// That a line keeps the bus of a flat memory.
[[nodiscard]] inline double flat_bus_cycles(const sim::Config& config) {
    const std::uint32_t bytes = config.memory.bytes_per_cycle;
    return double((config.l1.line_bytes + bytes - 1) / bytes);
}

/// More for a line that misses the L1 and is found in what lies below it, the L2 or a flat memory.
[[nodiscard]] inline double l2_cycles(const sim::Config& config) {
    if (has_flat_memory(config)) return config.memory.latency_cycles + flat_bus_cycles(config) + 2.0;
    return config.l2.latency_cycles + 2.0;
}

/// More for a line that misses the L2, with another row open, as mostly; 0 where there is none.
[[nodiscard]] inline double dram_cycles(const sim::Config& config) {
    if (has_flat_memory(config)) return 0;
    const auto& dram = config.dram;
    const std::uint32_t bus_cycles = (config.l2.line_bytes + dram.bytes_per_cycle - 1) / dram.bytes_per_cycle;
    return dram.t_rp_cycles + dram.t_rcd_cycles + dram.t_cas_cycles + bus_cycles + dram.latency_cycles + 2.0;
}

}  // namespace rtu::study
