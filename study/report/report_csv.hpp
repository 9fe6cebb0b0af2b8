#pragma once

#include <span>
#include <string>

#include "study/report/run_report.hpp"

namespace rtu::study {

/// RFC 4180: a header, then one row for each scene and workload, and one of the scene's total, in which unit
/// and memory columns are empty. Deterministic: host times are in the JSON only. Columns follow the first
/// report's units.
[[nodiscard]] std::string csv_report(std::span<const SceneReport> reports);

}  // namespace rtu::study
