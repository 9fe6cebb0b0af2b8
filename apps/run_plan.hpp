#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/machine_options.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/run_options.hpp"

namespace rtu::apps {

/// What the command line of `rtusim run` says, word for word; empty strings are options that were not given.
struct RunArguments {
    std::vector<std::string> scenes;
    std::string pairing = "edge_bbsa";
    std::string edge_identity = "position";
    std::string workloads = "primary,shadow,diffuse";
    std::string resolution = "256x256";
    std::string camera;
    std::string seed = "1";
    std::string rays;         ///< a file of rays or visits
    std::string rays_format;  ///< empty: by content or extension
    std::string ray_kind = "closest";
    bool is_forced = false;
    MachineOptions machine;
    std::string clock_mode = "fast";
    unsigned threads = 0;  ///< 0: all cores
    std::string json;
    std::string csv;
    std::string image_folder;
    bool is_checked = false;
    std::string fidelity = "cycle";
    std::string tolerance;  ///< percent; empty: 2
};

/// A run that is known to be possible as far as that can be told without reading the scenes.
struct RunPlan {
    study::RunOptions options;
    std::vector<study::SceneSource> scenes;
    std::vector<std::filesystem::path> inputs;  ///< every file that is read: no output may replace one
    study::FidelityLevel fidelity = study::FidelityLevel::Cycle;
    double tolerance = 0.02;
    unsigned threads = 0;
    bool is_json_to_stdout = false;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> csv;
    std::optional<std::filesystem::path> image_folder;
};

/// Checks everything that can be checked before the first simulation: names, numbers, the configuration, the
/// camera file, that every scene is a file and that every output can be written. Throws Error.
[[nodiscard]] RunPlan make_run_plan(const RunArguments& arguments);

}  // namespace rtu::apps
