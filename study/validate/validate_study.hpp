#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "model/workload.hpp"
#include "study/run_options.hpp"
#include "study/validate/rtl_reference.hpp"
#include "study/validate/validate_report.hpp"

namespace rtu::study {

/// What `rtusim validate` is asked. Everything is validated by whoever fills this in.
struct ValidateOptions {
    std::vector<SceneSource> scenes;
    std::vector<model::WorkloadKind> workloads;
    std::vector<ValidateConfig> configs;
    std::uint32_t ray_count = 2000;                    ///< of each workload at most; see rays_for()
    std::optional<std::filesystem::path> camera_file;  ///< as in RunOptions
    std::uint64_t seed = 1;
    ReferenceMachine reference;
    std::vector<std::string> sim_sets;  ///< for the report: what ValidateConfig::simulated changes
    /// Told of each scene's phases; may be empty.
    std::function<void(std::string_view scene, std::string_view phase)> progress;
};

/// Rays for a machine: `ray_count`, and with fewer than 16 slots as many times fewer, because they take as
/// many times more cycles each; at least 32, if there are.
[[nodiscard]] std::uint32_t rays_for(std::uint32_t ray_count, const sim::Config& config);

/// Runs the same rays through the reference and the simulator and compares first hits and counts, then
/// cycles. Ends at the first difference. The rays are spread evenly over a picture.
[[nodiscard]] ValidateReport run_validation(const ValidateOptions& options);

}  // namespace rtu::study
