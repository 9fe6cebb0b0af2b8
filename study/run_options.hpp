#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/camera.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "sim/clock_domain.hpp"
#include "sim/config.hpp"
#include "traces/ray_files.hpp"

namespace rtu::study {

/// What to simulate: a glTF file, or the built-in scene when there is no file.
struct SceneSource {
    std::optional<std::filesystem::path> file;

    /// The file's name without folder and extension, or `builtin`: names the scene, its camera and its
    /// pictures.
    [[nodiscard]] std::string name() const { return file ? file->stem().string() : "builtin"; }
};

/// A file of rays to simulate instead of the rays of workloads.
struct RayInput {
    std::filesystem::path file;
    traces::RayFormat format = traces::RayFormat::Trace;  ///< of rays or visits
    traces::ImportOptions import;                         ///< for formats that do not say
    bool is_forced = false;                               ///< a trace of another scene will do
};

/// How to simulate it. Everything is validated by whoever fills this in.
struct RunOptions {
    model::PairingMethod pairing;
    model::EdgeIdentity edge_identity = model::EdgeIdentity::Position;
    std::vector<model::WorkloadKind> workloads{model::WorkloadKind::Primary, model::WorkloadKind::Shadow,
                                               model::WorkloadKind::Diffuse};
    model::Resolution resolution;
    /// Cameras by scene name (see model::load_camera); a scene without an entry gets the automatic camera.
    std::optional<std::filesystem::path> camera_file;
    std::uint64_t seed = 1;
    /// Replaces workloads, resolution, camera and seed.
    std::optional<RayInput> rays;
    std::string preset = "default";  ///< only named in the report
    sim::Config config;              ///< the effective configuration
    sim::ClockMode clock_mode = sim::ClockMode::Fast;
    bool is_checked = false;    ///< compare every hit with the reference traversal and with Embree
    bool wants_pixels = false;  ///< fill SceneReport::pixels: see trace_pixels()
    /// Told at the start of each phase, and now and then within one; may be empty.
    std::function<void(std::string_view phase)> progress;

    /// Tells `progress` of a phase, if anybody listens.
    void tell(std::string_view phase) const {
        if (progress) progress(phase);
    }
};

}  // namespace rtu::study
