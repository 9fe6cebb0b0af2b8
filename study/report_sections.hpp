#pragma once

#include <string>

#include "study/run_report.hpp"

// The tables of the text report, one row for each workload and unit. What a machine does not count shows as
// 0.

namespace rtu::study {

/// Tests, cycles and MRPS of each workload and their total.
[[nodiscard]] std::string workload_table(const SceneReport& report);
/// Busy, starved, blocked and idle shares of each unit in each workload.
[[nodiscard]] std::string unit_table(const SceneReport& report);
/// Mean rays in flight, stack entries spilled and reloaded, replayed pair tests.
[[nodiscard]] std::string event_table(const SceneReport& report);
/// Hit rates and bytes of each cache: levels that count `line_reads`.
[[nodiscard]] std::string cache_table(const SceneReport& report);
/// Row hits and bandwidth of each DRAM: levels that count `row_hits`.
[[nodiscard]] std::string dram_table(const SceneReport& report);

}  // namespace rtu::study
