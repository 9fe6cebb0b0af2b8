#pragma once

#include <string>

#include "study/precision/precision_report.hpp"

namespace rtu::study {

/// For people: the answer of each scene, and its evidence in tables.
[[nodiscard]] std::string precision_text(const PrecisionReport& report);

/// Everything: `answers`, `rows` and `filters`; keys in docs/precision.md.
[[nodiscard]] std::string precision_json(const PrecisionReport& report);

/// All rows.
[[nodiscard]] std::string precision_csv(const PrecisionReport& report);

}  // namespace rtu::study
