#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/machine_options.hpp"
#include "study/pairing/pairing_options.hpp"
#include "study/run_options.hpp"

namespace rtu::apps {

/// What the command line of `rtusim pairing` says, word for word; empty strings are options that were not
/// given.
struct PairingArguments {
    std::vector<std::string> scenes;
    std::string baseline = "window:2";
    std::string methods = "edge_bbsa";
    std::string studies;
    std::string edge_identity = "position";
    std::string workloads = "primary,shadow,diffuse";
    std::string resolution = "256x256";
    std::string camera;
    std::string rotation = "0,0,0";
    std::string seed = "1";
    MachineOptions machine;
    unsigned threads = 0;  ///< 0: all cores
    std::string json;
    std::string csv;
    std::string html;
    std::string chart_folder;
};

/// A comparison that is known to be possible as far as that can be told without reading the scenes.
struct PairingPlan {
    study::PairingOptions options;
    std::vector<study::SceneSource> scenes;
    unsigned threads = 0;
    bool is_json_to_stdout = false;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> csv;
    std::optional<std::filesystem::path> html;
    std::optional<std::filesystem::path> chart_folder;
};

/// Checks everything that can be checked before the first simulation, gnuplot included when charts are
/// wanted. Throws Error.
[[nodiscard]] PairingPlan make_pairing_plan(const PairingArguments& arguments);

}  // namespace rtu::apps
