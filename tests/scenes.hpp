#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace rtu::test {

/// A real scene's file, from the folder named by RTUSIM_SCENES or else ../shared/scenes beside the project;
/// nothing when it is not there: skip the test with a message then.
inline std::optional<std::filesystem::path> scene_file(const std::string& file_name) {
    const char* folder = std::getenv("RTUSIM_SCENES");
    const std::filesystem::path path =
        (folder != nullptr ? std::filesystem::path(folder)
                           : std::filesystem::path(RTUSIM_SOURCE_DIR) / "../shared/scenes") /
        file_name;
    return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

}  // namespace rtu::test
