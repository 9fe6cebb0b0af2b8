#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "study/run_options.hpp"
#include "study/stability/stability_cases.hpp"

namespace rtu::study {

/// Rays a setting, at most: a ray's random numbers are those of its 32-bit index.
inline constexpr std::uint64_t max_stability_rays = 4'000'000'000;

/// What `rtusim stability` is asked.
struct StabilityOptions {
    std::vector<std::string> methods;  ///< empty: all
    std::vector<std::string> cases;    ///< empty: all
    std::uint64_t rays = 1'000;        ///< a setting, 1 to max_stability_rays
    std::uint64_t seed = 1;
    std::optional<SceneSource> scene;  ///< a scene whose triangles are one more case
    std::function<void(std::string_view scene, std::string_view phase)> progress;  ///< may be empty
};

/// What a case is, without its settings.
struct StabilityCaseInfo {
    int number = 0;
    std::string name, title, check;
};

/// One method under one setting.
struct StabilityRow {
    std::string method, contraction;
    std::size_t case_index = 0;  ///< into StabilityReport::cases
    std::string parameter, aim;
    Measured measured;
    Tally tally;
    bool is_comparison = false;  ///< as its setting
};

/// All that was asked, in the order of the cases, their settings, and the subjects.
struct StabilityReport {
    std::string version, compiler, scene;  ///< scene: empty without one
    std::uint64_t rays = 0, seed = 0;
    std::vector<std::string> methods;  ///< as the subjects' names come in the tables
    std::vector<StabilityCaseInfo> cases;
    std::vector<StabilityRow> rows;
};

/// The names of all cases, in the order of their numbers.
[[nodiscard]] std::vector<std::string> stability_case_names();

/// Throws Error, with the known ones, for a case or method that is not there or is given twice.
void check_stability_options(const StabilityOptions& options);

/// Runs every setting of the cases on all cores. The same for the same options whatever the number of
/// threads. A setting whose rays are tested against more than 256 triangles takes fewer rays, in proportion.
/// Throws Error as check_stability_options() and load_scene() do.
[[nodiscard]] StabilityReport run_stability(const StabilityOptions& options);

/// A value of a row: a count, a measure, or not measured.
using StabilityCell = std::variant<std::monostate, std::uint64_t, double>;
/// A number of a row under its key in JSON and CSV.
struct StabilityField {
    std::string_view key;
    StabilityCell (*value)(const StabilityRow& row);
};
/// All numbers of a row, in order.
[[nodiscard]] std::span<const StabilityField> stability_fields();

/// The report as aligned text: an overview of methods by cases, then a table for each case; for a single case
/// by parameter.
[[nodiscard]] std::string stability_text(const StabilityReport& report);
[[nodiscard]] std::string stability_json(const StabilityReport& report);
[[nodiscard]] std::string stability_csv(const StabilityReport& report);

/// Of rays on which something was to be found, how many went wrong in a way that a picture shows: leaks and
/// doubles where a surface's crossings are known, else false hits and misses and non-finite hits, else what
/// the case is about.
[[nodiscard]] std::uint64_t failures(const Measured& measured, const Tally& tally);

}  // namespace rtu::study
