#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/workload.hpp"
#include "study/methods/methods_report.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// What to measure. Everything is validated by whoever fills this in.
struct MethodsOptions {
    std::vector<std::string> methods;         ///< names; empty: all
    std::vector<model::methods::Form> forms;  ///< empty: all
    std::uint32_t triangle_count = 1024;      ///< of the random workload; even, 2 to 2^20
    std::uint32_t ray_count = 256;            ///< of the random workload, 1 to 2^20
    std::uint32_t repeats = 7;
    std::uint64_t seed = 1;
    std::vector<SceneSource> scenes;  ///< whose own mix of rays and leaves is measured too
    std::vector<model::WorkloadKind> workloads;
    std::optional<std::filesystem::path> camera_file;
    std::function<void(std::string_view phase)> progress;  ///< told now and then; may be empty
};

/// Throws Error, listing the known names, for one that is none.
void check_method_name(std::string_view name);
[[nodiscard]] model::methods::Form parse_form(std::string_view name);

/// Measures on one thread: minutes with all methods and several scenes. The hits are deterministic, times
/// not.
[[nodiscard]] MethodsReport run_methods_study(const MethodsOptions& options);

}  // namespace rtu::study
