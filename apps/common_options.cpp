#include "apps/common_options.hpp"

#include <set>

#include "apps/machine_options.hpp"
#include "model/error.hpp"

namespace rtu::apps {

CLI::Option* add_scenes_option(CLI::App& command, std::vector<std::string>& scenes) {
    return command.add_option("SCENE", scenes, "glTF 2.0 files (.gltf, .glb); none: the built-in scene")
        ->type_name("");
}

CLI::Option* add_workloads_option(CLI::App& command, std::string& workloads) {
    return command
        .add_option("--workload", workloads, "rays to trace, of primary, shadow, ao, diffuse, random")
        ->type_name("LIST")
        ->capture_default_str();
}

CLI::Option* add_resolution_option(CLI::App& command, std::string& resolution) {
    return command.add_option("--resolution", resolution, "picture size in pixels, one primary ray each")
        ->type_name("WxH")
        ->capture_default_str();
}

CLI::Option* add_camera_option(CLI::App& command, std::string& file) {
    return command
        .add_option("--camera", file,
                    "TOML with eye, target, up, tan_half_fov, in a table named like the scene;\n"
                    "without it, or without the scene's table, the camera is automatic")
        ->type_name("FILE")
        ->check(is_not_empty());
}

CLI::Option* add_seed_option(CLI::App& command, std::string& seed) {
    return command
        .add_option("--seed", seed, "of the random numbers, those of ao, diffuse and random rays too")
        ->type_name("N")
        ->capture_default_str();
}

CLI::Option* add_threads_option(CLI::App& command, std::uint32_t& threads) {
    return command.add_option("--threads", threads, "host threads at most, 0: all; no effect on results")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

ThreadLimit::ThreadLimit(std::uint32_t threads) {
    if (threads > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, threads);
}

void check_scene_names(const std::vector<study::SceneSource>& scenes) {
    std::set<std::string> names;
    for (const study::SceneSource& scene : scenes) {
        if (!names.insert(scene.name()).second) {
            throw Error("two scenes are called '{}', and the report could not tell them apart", scene.name());
        }
    }
}

std::vector<std::filesystem::path> input_files(const std::vector<study::SceneSource>& scenes,
                                               const std::vector<std::string>& others) {
    std::vector<std::filesystem::path> files;
    for (const study::SceneSource& scene : scenes) {
        if (scene.file) files.push_back(*scene.file);
    }
    for (const std::string& file : others) {
        if (!file.empty()) files.emplace_back(file);
    }
    return files;
}

}  // namespace rtu::apps
