#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/camera.hpp"
#include "model/workload.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/run_options.hpp"

// What the words of a command line mean, for all commands that run scenes. All throw Error, in one line that
// names the option, for what they do not understand.

namespace rtu::apps {

/// Nothing for an empty text: an option that was not given.
[[nodiscard]] std::optional<std::filesystem::path> optional_path(const std::string& text);

/// The parts between the commas of "a,b,c".
[[nodiscard]] std::vector<std::string_view> split(std::string_view text);

/// The same for an option that may not name anything twice; nothing for an empty text.
[[nodiscard]] std::vector<std::string> parse_list(std::string_view option, std::string_view text);

/// Digits only: no sign, no blanks, no overflow; nothing for anything else.
[[nodiscard]] std::optional<std::uint64_t> parse_count(std::string_view text);

[[nodiscard]] std::uint64_t parse_seed(std::string_view text);

/// "640x480".
[[nodiscard]] model::Resolution parse_resolution(std::string_view text);

/// "primary,shadow": known names, none twice.
[[nodiscard]] std::vector<model::WorkloadKind> parse_workloads(std::string_view text);

/// Every name must be a file that is there; without names, the built-in scene.
[[nodiscard]] std::vector<study::SceneSource> parse_scenes(const std::vector<std::string>& names);

/// The same for a command that may run without scenes: no names, no scenes; `builtin` is the built-in one.
[[nodiscard]] std::vector<study::SceneSource> parse_scenes_or_builtin(const std::vector<std::string>& names);

/// A file of rays: it must be there, and its format known or given.
[[nodiscard]] study::RayInput parse_ray_input(const std::string& file, const std::string& format,
                                              const std::string& kind, bool is_forced);

/// --fidelity: counts, analytic, sampled, cycle or auto.
[[nodiscard]] study::FidelityLevel parse_fidelity(std::string_view text);

/// --tolerance in percent, as a share: "2" is 0.02. From 0.6, below which no sample is known to be right,
/// to 50.
[[nodiscard]] double parse_tolerance(std::string_view text);

[[nodiscard]] bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Reads every scene's camera once, for its errors.
void check_cameras(const std::optional<std::filesystem::path>& file,
                   const std::vector<study::SceneSource>& scenes);

/// A file that can be written and replaces no input.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

}  // namespace rtu::apps
