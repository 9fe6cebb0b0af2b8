#pragma once

#include <string>
#include <vector>

#include "study/area/area_report.hpp"
#include "study/study_table.hpp"

namespace rtu::study {

/// What a machine is made of: boxes of every width, the pair unit in every mode, the machine's parts, all
/// presets, what a clock leaves for a gate; and with scenes, what sharing the common edge saves and costs.
[[nodiscard]] std::vector<StudyTable> area_tables(const AreaReport& report);

/// In one or two sentences: what `dual_shared` saves against `dual_independent` in gates, and what it costs
/// in cycles on the rays that were simulated.
[[nodiscard]] std::string area_answer(const AreaReport& report);

}  // namespace rtu::study
