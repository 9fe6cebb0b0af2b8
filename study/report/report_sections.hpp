#pragma once

#include <string>
#include <string_view>

#include "study/report/run_report.hpp"

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
/// What the last level of memory is called: DRAM, or Memory where it is flat.
[[nodiscard]] std::string_view main_memory_title(const SceneReport& report);
/// Its row hits and bandwidth: levels that count `read_bytes`.
[[nodiscard]] std::string main_memory_table(const SceneReport& report);

}  // namespace rtu::study
