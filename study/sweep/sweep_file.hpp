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
#include "study/run_options.hpp"
#include "study/sweep/sweep_constraint.hpp"
#include "study/sweep/sweep_objective.hpp"

// What a sweep file says. The format is described in docs/sweeps.md.

namespace rtu::study {

/// A scene, with the rays that workloads make in it or with rays from a file.
struct SweepInput {
    SceneSource scene;
    std::optional<RayInput> rays;
    std::string place;  ///< FILE:LINE

    /// The scene's name, and behind a '/' that of the file of rays.
    [[nodiscard]] std::string name() const {
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
};

/// Reads a sweep file. Throws Error with file and line for text that is not TOML, for unknown, repeated and
/// missing keys, and for values that cannot be. Files that it names are relative to its folder.
[[nodiscard]] SweepFile read_sweep_file(const std::filesystem::path& path);

/// The same of its text; `path` is the name in errors and the folder of relative files.
[[nodiscard]] SweepFile parse_sweep(std::string_view text, const std::filesystem::path& path);

}  // namespace rtu::study
