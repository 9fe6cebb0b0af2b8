#pragma once

#include <string>

#include "study/area/area_report.hpp"

namespace rtu::study {

/// For people: the answer, and its evidence in tables.
[[nodiscard]] std::string area_text(const AreaReport& report);

/// Everything: `units`, `parts`, `presets`, `modes` and `rows`; keys in docs/area.md.
[[nodiscard]] std::string area_json(const AreaReport& report);

/// The parts of the machine and of all presets, and the rows of the scenes; the column `table` tells which.
[[nodiscard]] std::string area_csv(const AreaReport& report);

/// One self-contained page with all tables and charts.
[[nodiscard]] std::string area_html(const AreaReport& report);

}  // namespace rtu::study
