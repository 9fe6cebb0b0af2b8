#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/config.hpp"

namespace rtu::study {

/// A machine that exists both in the simulator and in the RTL reference.
struct ValidateConfig {
    std::string name;
    std::vector<std::string> sets;  ///< how it differs from the validated machine, "key=value" each
    sim::Config config;
    std::optional<sim::Config> simulated = std::nullopt;  ///< what the simulator is instead, in an ablation
};

/// One workload of one scene on one machine, in the RTL and in the simulator.
struct ValidateRow {
    std::string scene;
    std::string workload;
    std::string config;
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t rtl_cycles = 0;
    std::uint64_t sim_cycles = 0;
    /// Triangles whose sides the first pass left open: what the hit unit takes for them is only nearly
    /// simulated.
    std::uint64_t side_tests = 0;
    std::uint32_t clock_mhz = 0;
    double rtl_cpu_seconds = 0;  ///< of the host
    double sim_cpu_seconds = 0;

    /// (simulator - RTL) / RTL cycles in percent; 0 for no cycles.
    [[nodiscard]] double error_percent() const;
    [[nodiscard]] double rtl_rays_per_second() const { return rate(rtl_cpu_seconds); }
    [[nodiscard]] double sim_rays_per_second() const { return rate(sim_cpu_seconds); }

  private:
    [[nodiscard]] double rate(double seconds) const { return seconds > 0 ? double(rays) / seconds : 0; }
};

/// What is not the same in both: a hit, or a count.
struct ValidateDifference {
    std::string scene;
    std::string workload;
    std::string config;
    std::optional<std::uint64_t> ray;  ///< the first one whose hits differ; none: a count differs
    std::string what;                  ///< "expected ..., got ...", the simulator's first
};

struct ValidateReport {
    std::string version;
    std::uint64_t seed = 0;
    std::vector<std::string> sim_sets;  ///< what was changed in the simulator only
    std::vector<ValidateConfig> configs;
    std::vector<ValidateRow> rows;  ///< by scene, configuration, workload
    /// Ends the validation: the rows are those before it.
    std::optional<ValidateDifference> difference;
};

/// Of the absolute errors; 0 without rows.
struct ErrorSummary {
    double worst_percent = 0;
    double median_percent = 0;
    std::uint64_t within_2_percent = 0;
    std::uint64_t rows = 0;
};

/// Rows that met no triangle with open sides, and those of them whose cycles are the same in both.
struct ExactRows {
    std::uint64_t without_side_tests = 0;
    std::uint64_t exact = 0;
};

[[nodiscard]] ExactRows exact_rows(std::span<const ValidateRow> rows);

[[nodiscard]] ErrorSummary error_summary(std::span<const ValidateRow> rows);

/// How many times more rays a second the simulator does than the RTL, over all rows; 0 without any.
[[nodiscard]] double speedup(std::span<const ValidateRow> rows);

}  // namespace rtu::study
