#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "model/camera.hpp"
#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "sim/config.hpp"
#include "sim/machine.hpp"
#include "study/report/run_report.hpp"
#include "study/run_options.hpp"

// The steps from a scene's file to the counts of a simulation, for everything that runs scenes.

namespace rtu::study {

/// A scene as it was read.
struct LoadedScene {
    model::TriangleMesh mesh;
    SceneFacts facts;
    std::string input_hash;  ///< fingerprint() of the mesh
};

/// Reads the scene's file, or makes the built-in scene; throws Error as model::load_gltf() does.
[[nodiscard]] LoadedScene load_scene(const SceneSource& source);

/// A mesh's pairs in the machine's memory, proven right by model::validate().
struct BuiltScene {
    model::MemoryImage image;
    PairingFacts pairing;
    BvhFacts bvh;
};

/// Pairs the mesh and builds the tree over the pairs.
[[nodiscard]] BuiltScene build_scene(const model::TriangleMesh& mesh, model::PairingMethod method,
                                     model::EdgeIdentity identity, const sim::Config::Bvh& bvh);

/// A camera, and where it comes from: "automatic", "built-in", or the camera file's name.
struct ChosenCamera {
    model::Camera camera;
    std::string source;
};

/// The scene's camera: that of the file when it has one for the scene, else the built-in or automatic one.
/// Does not depend on the pairing of `image`.
[[nodiscard]] ChosenCamera choose_camera(const model::TriangleMesh& mesh, const model::MemoryImage& image,
                                         const SceneSource& source,
                                         const std::optional<std::filesystem::path>& camera_file);

/// What a simulation counted, under the names of reports.
[[nodiscard]] WorkloadReport workload_report(const std::string& name, std::uint64_t hit_count,
                                             const sim::MachineResult& result);

}  // namespace rtu::study
