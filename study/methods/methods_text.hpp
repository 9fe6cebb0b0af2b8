#pragma once

#include <optional>
#include <string>

#include "study/methods/methods_report.hpp"

namespace rtu::study {

/// The report as aligned tables.
[[nodiscard]] std::string methods_text(const MethodsReport& report);

/// The report as JSON: rows[], scaling[] and how they were measured. Ends with a line feed.
[[nodiscard]] std::string methods_json(const MethodsReport& report);

/// The rows as CSV.
[[nodiscard]] std::string methods_csv(const MethodsReport& report);

/// The row of the same workload, form and width as `row` for another method; null when it was not measured.
[[nodiscard]] const MethodsRow* same_row(const MethodsReport& report, const MethodsRow& row,
                                         std::string_view method);

/// Speed of `row` over that of Wald's method in the same workload, form and width.
[[nodiscard]] std::optional<double> ratio_to_wald(const MethodsReport& report, const MethodsRow& row);

}  // namespace rtu::study
