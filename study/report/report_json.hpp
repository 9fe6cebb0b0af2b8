#pragma once

#include <span>
#include <string>

#include "study/report/run_report.hpp"

namespace rtu::study {

/// One object for one scene, an array for several, indented, ended by a line feed. Keys and meanings:
/// docs/report.md. `check` is always there; `compared` is 0 when no check was asked for.
[[nodiscard]] std::string json_report(std::span<const SceneReport> reports);

}  // namespace rtu::study
