#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/machine_options.hpp"
#include "apps/report_output.hpp"
#include "study/stream/stream_study.hpp"

namespace rtu::apps {

/// What the command line of `rtusim stream` says, word for word; empty strings are options that were not
/// given.
struct StreamArguments {
    std::string scene;
    std::uint32_t ray_count = study::StreamOptions{}.ray_count;
    std::uint32_t pair_count = study::StreamOptions{}.pair_count;
    std::string pairing = "edge_bbsa";
    std::string edge_identity = "position";
    std::string workload = "primary";
    std::string camera;
    std::string seed = "1";
    std::string modes;
    std::string links;
    std::string batches;
    std::string read_back;
    bool has_published = false;
    MachineOptions machine;
    ReportOutput output;
    std::string html;
    std::string chart_folder;
};

/// A stream that is known to be possible as far as that can be told without reading the scene.
struct StreamPlan {
    study::StreamOptions options;
    std::optional<std::filesystem::path> html;
    std::optional<std::filesystem::path> chart_folder;
};

/// Checks everything that can be checked before the first simulation, gnuplot included when charts are
/// wanted. Throws Error.
[[nodiscard]] StreamPlan make_stream_plan(const StreamArguments& arguments);

}  // namespace rtu::apps
