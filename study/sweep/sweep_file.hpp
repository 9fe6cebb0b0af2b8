#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/camera.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "sim/effective_config.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/run_options.hpp"
#include "study/sweep/sweep_chart.hpp"
#include "study/sweep/sweep_constraint.hpp"
#include "study/sweep/sweep_objective.hpp"

// What a sweep file says. The format is described in docs/sweeps.md.

namespace rtu::study {

/// A scene, with the rays that workloads make in it or with rays from a file.
struct SweepInput {
    SceneSource scene;
    std::optional<RayInput> rays;
    std::optional<std::filesystem::path> camera_file;  ///< instead of the sweep's
    std::optional<std::uint64_t> seed;                 ///< instead of the sweep's
    std::string label;  ///< what the sweep calls it; empty: as the scene is called
    std::string place;  ///< FILE:LINE

    /// The label, or the scene's name and behind a '/' that of the file of rays.
    [[nodiscard]] std::string name() const {
        if (!label.empty()) return label;
        return rays ? scene.name() + "/" + rays->file.stem().string() : scene.name();
    }
};

/// Keys that change together, and the values that they take: one key for a plain axis, several for a linked
/// one.
struct SweepAxis {
    std::vector<std::vector<sim::ConfigAssignment>> settings;  ///< [settings][keys]
    std::string place;
};

/// A part of the grid instead of all of it.
struct SweepSubset {
    enum class Method : std::uint8_t { Random, Sobol };
    Method method = Method::Sobol;
    std::uint64_t designs = 0;
    std::uint64_t seed = 1;
    std::string place;
};

/// A sweep as it was written; what can be checked value by value is checked.
struct SweepFile {
    std::string name;  ///< of the file, without folder and extension
    std::string text;
    std::vector<SweepInput> inputs;
    std::vector<model::WorkloadKind> workloads;
    model::Resolution resolution;
    std::optional<std::filesystem::path> camera_file;
    std::uint64_t seed = 1;
    model::EdgeIdentity edge_identity = model::EdgeIdentity::Position;
    std::vector<model::PairingMethod> pairings;
    std::vector<std::string> presets;
    std::vector<sim::ConfigAssignment> fixed;
    std::vector<SweepAxis> axes;
    std::vector<SweepConstraint> constraints;
    std::optional<SweepSubset> subset;
    std::vector<SweepObjective> objectives;
    FidelityLevel fidelity = FidelityLevel::Cycle;  ///< of all points but those of the front
    double tolerance = 0.02;                        ///< of sampled and auto, as in SampledOptions
    std::vector<SweepChart> charts;
};

/// Reads a sweep file. Throws Error with file and line for text that is not TOML, for unknown, repeated and
/// missing keys, and for values that cannot be. Files that it names are relative to its folder or, when they
/// are not there, to `scenes` unless that is empty.
[[nodiscard]] SweepFile read_sweep_file(const std::filesystem::path& path,
                                        const std::filesystem::path& scenes = {});

/// The same of its text; `path` is the name in errors, and its folder that of relative files.
[[nodiscard]] SweepFile parse_sweep(std::string_view text, const std::filesystem::path& path,
                                    const std::filesystem::path& scenes = {});

}  // namespace rtu::study
