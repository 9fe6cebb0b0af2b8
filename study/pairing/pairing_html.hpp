#pragma once

#include <string>
#include <vector>

#include "study/chart/chart.hpp"
#include "study/pairing/pairing_report.hpp"

namespace rtu::study {

/// The report as one self-contained HTML page: every table of the text, and every chart, drawn by gnuplot.
/// Throws Error as draw() does.
[[nodiscard]] std::string pairing_html(const PairingReport& report);

/// Every chart of the report: those of the comparison, then those of each study.
[[nodiscard]] std::vector<Chart> pairing_charts(const PairingReport& report);

}  // namespace rtu::study
