#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/workload.hpp"
#include "sim/config.hpp"
#include "sim/effective_config.hpp"
#include "study/area/area_report.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// What `rtusim area` is asked. Everything is validated by whoever fills this in.
struct AreaOptions {
    std::string preset = "default";
    sim::Config config;
    std::vector<NamedConfig> presets;  ///< every preset, to be compared
    std::vector<SceneSource> scenes;   ///< to be simulated in every mode of the pair unit; may be empty
    std::vector<model::WorkloadKind> workloads;
    model::Resolution resolution;
    std::optional<std::filesystem::path> camera_file;  ///< as in RunOptions
    std::uint64_t seed = 1;
    /// Told of each scene's phases; may be empty.
    std::function<void(std::string_view scene, std::string_view phase)> progress;
};

/// Counts the machine and the presets, and simulates the scenes in the three modes of the pair unit, on the
/// same rays. Throws as run_scene() does.
[[nodiscard]] AreaReport run_area_study(const AreaOptions& options);

}  // namespace rtu::study
