#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/fidelity/fidelity_levels.hpp"
#include "study/report/run_report.hpp"
#include "study/sweep/sweep_tree.hpp"

namespace rtu::study {

/// A raw count that a sweep keeps of each workload.
struct SweepCount {
    std::string_view name;  ///< of the column
    std::string_view unit;
    std::string_view meaning;
    std::uint64_t (*value)(const WorkloadReport& workload);
};

/// All of them, in the order of the columns.
[[nodiscard]] std::span<const SweepCount> sweep_counts();

/// What one workload of a point gave.
struct SweepRow {
    std::string workload;
    std::string level = "cycle";  ///< of fidelity that the figures are from; of a total the least exact one
    double cycles_low = 0;        ///< 95 % interval; without width at level cycle
    std::optional<double> cycles_high = std::nullopt;  ///< nothing: no bound
    /// [sweep_counts().size()]; estimates have ray_count and cycles only.
    std::vector<std::optional<std::uint64_t>> counts{};
};

/// What one point gave. Deterministic outside `cpu_seconds`.
struct SweepResult {
    std::string point;
    std::string error;  ///< why there are no rows; empty: there are
    double paired_percent = 0;
    std::vector<SweepRow> rows;  ///< a row for each workload, then one named `total`
    double cpu_seconds = 0;      ///< of the host, for the simulation
};

/// Simulates every ray of the tree on the machine, workload after workload, each in cold caches. `config`
/// must be valid, and its tree that of `tree`. Throws as sim::simulate() does.
[[nodiscard]] SweepResult simulate_point(const std::string& point, const sim::Config& config,
                                         const SweepTree& tree);

/// Estimates every workload of a tree that was prepared with its rays at a level other than cycle.
[[nodiscard]] SweepResult estimate_point(const std::string& point, const sim::Config& config,
                                         const SweepTree& tree, FidelityLevel level,
                                         const SampledOptions& options);

/// As one line of JSON, without a line feed.
[[nodiscard]] std::string to_json_line(const SweepResult& result);
/// Throws Error for anything that to_json_line() does not write.
[[nodiscard]] SweepResult parse_sweep_result(std::string_view line);

}  // namespace rtu::study
