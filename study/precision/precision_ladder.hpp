#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/workload.hpp"
#include "study/precision/precision_rays.hpp"
#include "study/precision/precision_report.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// What to measure. Everything is validated by whoever fills this in.
struct PrecisionOptions {
    std::vector<SceneSource> scenes;
    std::vector<model::WorkloadKind> workloads{model::WorkloadKind::Primary, model::WorkloadKind::Diffuse};
    std::vector<std::string> methods;  ///< names of emulated_methods(); empty: all
    std::uint32_t ray_count = 4000;    ///< of each workload, and at most as many at edges and vertices
    double t_tolerance = 0x1p-10;      ///< how far t may be off, of itself
    double wrong_per_million = 1000;   ///< rays that may be wrong
    std::uint64_t seed = 1;
    std::optional<std::filesystem::path> camera_file;
    std::function<void(std::string_view phase)> progress;  ///< told now and then; may be empty
};

/// All formats of the ladder: exponents of 8 and 10 bits with 7 to 23 bits of mantissa, and fp16.
[[nodiscard]] std::vector<model::methods::NumberFormat> ladder_formats();

/// The rays on which one scene is judged: those of every workload, and as many aimed ones as of a workload.
struct PrecisionRays {
    std::vector<RayTriangles> sampled;
    std::vector<RayTriangles> aimed;
};

/// Loads the scene and samples its rays. Throws Error as load_scene() does.
[[nodiscard]] PrecisionRays precision_rays(const SceneSource& source, const PrecisionOptions& options);

/// The rows of one scene, methods in the order of emulated_methods(), `exact` last, formats in that of
/// ladder_formats(). The same whatever the number of threads.
[[nodiscard]] std::vector<PrecisionRow> precision_rows(const std::string& scene, const PrecisionRays& rays,
                                                       const PrecisionOptions& options);

/// The quantised filters of one scene: exponents of 8 bits, 1 to 12 bits of mantissa.
[[nodiscard]] std::vector<FilterRow> filter_rows(const std::string& scene,
                                                 std::span<const RayTriangles> rays);

/// A row is good enough when, with 95 % confidence, no more rays are wrong than tolerated. The answer is the
/// row of least area among those from which on every wider format of the same method is good enough, too.
[[nodiscard]] PrecisionReport run_precision_study(const PrecisionOptions& options);

}  // namespace rtu::study
