#pragma once

#include "sim/config.hpp"
#include "sim/machine.hpp"

namespace rtu::study {

/// NAND2 gates of all RTUs of a machine with their L1 control, registers included; memory cells, L2, DRAM and
/// links are not counted (docs/area.md). Of any valid configuration.
[[nodiscard]] double machine_gates(const sim::Config& config);

/// Million rays per second that a run of this machine gave, at its clock, for each million of its gates; 0
/// for a run of no cycles.
[[nodiscard]] double mrps_per_mgate(const sim::Config& config, const sim::MachineResult& result);

}  // namespace rtu::study
