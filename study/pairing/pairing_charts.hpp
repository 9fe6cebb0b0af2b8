#pragma once

#include <vector>

#include "study/chart/chart.hpp"
#include "study/pairing/pairing_report.hpp"

namespace rtu::study {

/// The charts of the comparison, one a method: change of box tests, pair tests and MRPS of every scene, with
/// the published values where there are any. Empty for no rows.
[[nodiscard]] std::vector<Chart> comparison_charts(const PairingReport& report);

/// The charts of a study: paired percent where the study changes it, and the change of MRPS.
[[nodiscard]] std::vector<Chart> study_charts(const PairingReport& report, const PairingStudyTable& study);

}  // namespace rtu::study
