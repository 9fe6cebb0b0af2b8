#pragma once

#include <string>
#include <vector>

#include "study/precision/precision_report.hpp"
#include "study/study_table.hpp"

namespace rtu::study {

/// In one or two sentences: the cheapest method and format that is exact enough for the scene's rays, what
/// binary32 would take, and what one bit less does.
[[nodiscard]] std::string precision_answer(const PrecisionReport& report, const PrecisionAnswer& scene);

/// The evidence: the narrowest format of every method, the answer's ladder, the quantised filters.
[[nodiscard]] std::vector<StudyTable> precision_tables(const PrecisionReport& report,
                                                       const PrecisionAnswer& scene);

}  // namespace rtu::study
