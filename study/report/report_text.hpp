#pragma once

#include <span>
#include <string>

#include "study/report/run_report.hpp"

namespace rtu::study {

/// The report of each scene as aligned tables, at most 100 columns wide as long as names are short; for
/// several scenes an overview, side by side, comes last. How to read it: docs/report.md.
[[nodiscard]] std::string text_report(std::span<const SceneReport> reports);

}  // namespace rtu::study
