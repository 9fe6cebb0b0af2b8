#pragma once

#include <vector>

#include "study/area/area_report.hpp"
#include "study/chart/any_chart.hpp"

namespace rtu::study {

/// What sharing the common edge saves against what it costs, for the pair unit alone and for the machine, and
/// the three modes side by side; and the presets' parts. Charts that need scenes are left out without them.
[[nodiscard]] std::vector<AnyChart> area_charts(const AreaReport& report);

}  // namespace rtu::study
