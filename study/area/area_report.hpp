#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/config.hpp"
#include "study/area/area_model.hpp"
#include "study/area/area_objective.hpp"

namespace rtu::study {

/// A machine, and what it is called in tables.
struct NamedConfig {
    std::string name;
    sim::Config config;
};

/// What one machine is made of.
struct MachineArea {
    NamedConfig machine;
    std::vector<AreaPart> parts;  ///< of one RTU

    [[nodiscard]] AreaTotal rtu() const { return total(parts); }
    /// All RTUs of the machine, without the L2.
    [[nodiscard]] double gates() const { return machine_gates(machine.config); }
    /// The parts of one unit of the RTU, together.
    [[nodiscard]] AreaTotal unit(std::string_view name) const;
};

[[nodiscard]] MachineArea machine_area(NamedConfig machine);

/// The machine's pair unit in one mode.
struct ModeArea {
    sim::PairMode mode{};
    AreaTotal pair;  ///< of one RTU
    double machine_gates = 0;
};

/// One workload of one scene on the machine with the pair unit in one mode: raw counts.
struct AreaRow {
    std::string scene;
    std::string workload;
    sim::PairMode mode{};
    std::uint64_t rays = 0;
    std::uint64_t cycles = 0;
    std::uint64_t pair_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t exact_tests = 0;
    std::uint64_t replays = 0;
    std::uint64_t survivors = 0;        ///< pairs that hit units were given
    std::uint64_t tester_cycles = 0;    ///< that testers were held
    std::uint64_t hit_unit_cycles = 0;  ///< that hit units were held
    double mrps = 0;
    double mrps_per_mgate = 0;  ///< of the whole machine
    /// What the pair unit alone would let through: rays over the cycles that its most used part is held.
    double pair_limit_mrps = 0;
    double pair_limit_mrps_per_mgate = 0;  ///< of the pair unit
};

struct AreaReport {
    std::string version;
    std::uint64_t seed = 0;
    MachineArea machine;               ///< what was asked for
    std::vector<MachineArea> presets;  ///< all of them
    std::vector<ModeArea> modes;       ///< the machine in each mode, in the order of sim::PairMode
    std::vector<AreaRow> rows;         ///< by scene, workload, mode; empty without scenes
};

/// The row of the same scene and workload in that mode.
[[nodiscard]] const AreaRow& in_mode(const AreaReport& report, const AreaRow& row, sim::PairMode mode);

/// A rate of all workloads of a scene together in one mode: their rays over the sum of their times, `rate`
/// being one of AreaRow's; workloads whose rate is 0 are left out.
[[nodiscard]] double scene_rate(const AreaReport& report, std::string_view scene, sim::PairMode mode,
                                double AreaRow::*rate);

/// What dual_shared saves against dual_independent in gates of the pair unit, and of the machine, in percent.
[[nodiscard]] double saved_pair_percent(const AreaReport& report);
[[nodiscard]] double saved_machine_percent(const AreaReport& report);

}  // namespace rtu::study
