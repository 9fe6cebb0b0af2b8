#pragma once

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/run_options.hpp"

// What commands that study scenes ask alike, in the same words. Each value is what the command line says, to
// be read by the functions of option_values.hpp.

namespace rtu::apps {

/// Adds the scenes, any number of files; none: the built-in scene.
CLI::Option* add_scenes_option(CLI::App& command, std::vector<std::string>& scenes);

/// Adds --workload LIST.
CLI::Option* add_workloads_option(CLI::App& command, std::string& workloads);

/// Adds --resolution WxH.
CLI::Option* add_resolution_option(CLI::App& command, std::string& resolution);

/// Adds --camera FILE.
CLI::Option* add_camera_option(CLI::App& command, std::string& file);

/// Adds --seed N.
CLI::Option* add_seed_option(CLI::App& command, std::string& seed);

/// Adds --threads N, 0 to 1024.
CLI::Option* add_threads_option(CLI::App& command, std::uint32_t& threads);

/// As long as it lives, so many host threads at most; 0: all.
class ThreadLimit {
  public:
    explicit ThreadLimit(std::uint32_t threads);

  private:
    std::optional<tbb::global_control> control_;
};

/// Throws Error where two scenes have one name, by which a report tells them apart.
void check_scene_names(const std::vector<study::SceneSource>& scenes);

/// The files of the scenes, and those of `others` that are named: what no output may replace.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const std::vector<study::SceneSource>& scenes,
                                                             const std::vector<std::string>& others);

}  // namespace rtu::apps
