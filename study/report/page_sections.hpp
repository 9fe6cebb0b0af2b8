#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "study/report/page_content.hpp"
#include "study/report/run_report.hpp"

// A section of the report page for each kind of result. The functions that take JSON throw Json::exception
// where something is missing or of another type; `id` is left empty.

namespace rtu::study {

/// A scene's run, and what to call it: the scene's name, and more where that is not enough.
struct PageRun {
    SceneReport report;
    std::string label;
};

/// MRPS, unit cycles, use of parts, memory traffic and misses of runs. Throws Error for a machine that there
/// cannot be.
[[nodiscard]] PageSection runs_section(std::span<const PageRun> runs);

[[nodiscard]] PageSection pairing_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection fidelity_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection stability_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection methods_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection precision_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection area_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection validate_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection stream_section(const nlohmann::ordered_json& json);
[[nodiscard]] PageSection box_tests_section(const nlohmann::ordered_json& json);

/// Of what `rtusim sweep --json` wrote.
[[nodiscard]] PageSection sweep_section(const nlohmann::ordered_json& json);
/// Of a database of sweeps, with its front. Throws Error as SweepDatabase does.
[[nodiscard]] PageSection sweep_database_section(const std::filesystem::path& path);

}  // namespace rtu::study
