#pragma once

#include <string>
#include <vector>

#include "study/chart/any_chart.hpp"
#include "study/study_table.hpp"
#include "study/validate/validate_report.hpp"

namespace rtu::study {

/// In one or two sentences: how well the cycles agree, or what differs.
[[nodiscard]] std::string validate_answer(const ValidateReport& report);

/// The machines with their worst and median error, and the cycles of every row.
[[nodiscard]] std::vector<StudyTable> validate_tables(const ValidateReport& report);

/// The error of every machine on every scene, all workloads together. Empty without rows.
[[nodiscard]] std::vector<AnyChart> validate_charts(const ValidateReport& report);

/// For people: the answer, and its evidence in tables.
[[nodiscard]] std::string validate_text(const ValidateReport& report);

/// Everything: `summary`, `difference`, `configs` and `rows`; keys in docs/validation.md.
[[nodiscard]] std::string validate_json(const ValidateReport& report);

/// All rows.
[[nodiscard]] std::string validate_csv(const ValidateReport& report);

/// One self-contained page with all tables and charts.
[[nodiscard]] std::string validate_html(const ValidateReport& report);

}  // namespace rtu::study
