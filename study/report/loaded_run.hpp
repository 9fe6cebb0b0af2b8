#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/config.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

/// A scene's report as `rtusim run --json` wrote it; the camera's numbers are left out. Throws
/// Json::exception where something is missing or of another type.
[[nodiscard]] SceneReport report_of_json(const nlohmann::ordered_json& json);

/// The machine of a report; keys that the report does not name have their defaults. Throws Error, which
/// `place` begins, for a key or value that no machine has.
[[nodiscard]] sim::Config machine_of(const SceneReport& report, const std::string& place);

}  // namespace rtu::study
