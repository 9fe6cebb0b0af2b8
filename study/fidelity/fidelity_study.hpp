#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/named_machine.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// What to compare. Everything is validated by whoever fills this in.
struct FidelityOptions {
    std::vector<SceneSource> scenes{1};
    std::vector<NamedMachine> machines;
    std::vector<model::WorkloadKind> workloads{model::WorkloadKind::Primary, model::WorkloadKind::Shadow,
                                               model::WorkloadKind::Diffuse};
    std::vector<FidelityLevel> levels{FidelityLevel::Counts, FidelityLevel::Analytic, FidelityLevel::Sampled,
                                      FidelityLevel::Auto};
    model::Resolution resolution{512, 512};
    std::optional<std::filesystem::path> camera_file;
    std::uint64_t seed = 1;
    double tolerance = 0.02;
    bool ranks_configurations = true;  ///< of the first scene, on the first machine
    /// For the level rtl: a picture of its own, on the machine of the RTL, beside all machines.
    model::Resolution rtl_resolution{48, 48};
    std::function<void(std::string_view phase)> progress;
};

/// What one level says of one workload on one machine. MRPS are of the modelled machine, host rays a second
/// of the host: all rays of the workload over the CPU time that the level took, rays included.
struct FidelityRow {
    std::string scene, machine, workload;
    std::string level;  ///< that was asked for; `account` tells what auto chose
    double mrps = 0, mrps_low = 0, mrps_high = 0;
    std::optional<double> error_percent;  ///< of mrps, against every ray through the cycle model; see docs
    std::uint64_t simulated_rays = 0, traced_rays = 0, total_rays = 0;
    double host_rays_per_second = 0;
    std::optional<double> speedup;  ///< over the cycle level
    std::string account;
    /// Whether the interval holds what the cycle level found; nothing without it.
    std::optional<bool> is_inside;
};

/// How a level ranks machines that differ in one or two keys.
struct FidelityRanking {
    std::string scene, workload, level;
    std::uint32_t machines = 0;
    double tau = 0;  ///< Kendall's tau-b against the cycle level: 1 the same order, -1 the opposite
    double host_seconds = 0;
};

struct FidelityReport {
    std::string version;
    model::Resolution resolution;
    std::uint64_t seed = 1;
    double tolerance = 0;
    std::vector<FidelityRow> rows;  ///< by scene, machine, workload, level; cycle first
    std::vector<FidelityRanking> rankings;
};

/// Every level and the cycle level on everything. Host CPU seconds are those of one thread when oneTBB is
/// limited to one.
[[nodiscard]] FidelityReport run_fidelity_study(const FidelityOptions& options);

/// What a level said, as a row.
[[nodiscard]] FidelityRow fidelity_row(const LevelResult& result, std::uint32_t clock_mhz);

/// Kendall's tau-b of two lists of the same length; 0 when one of them has a single value only.
[[nodiscard]] double kendall_tau(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace rtu::study
