#pragma once

#include <string>

#include "model/camera.hpp"
#include "model/memory_image.hpp"
#include "model/mesh.hpp"

namespace rtu::bench {

/// A scene ready to trace: edge_bbsa by position, 4 wide, one pair a leaf.
struct BuiltScene {
    model::TriangleMesh mesh;
    model::MemoryImage image;
    model::Camera camera;
};

/// `builtin`, or a file NAME.glb of the scene folder (RTUSIM_SCENES, else ../shared/scenes beside the
/// project).
[[nodiscard]] bool has_scene(const std::string& name);
[[nodiscard]] model::TriangleMesh load_scene(const std::string& name);

/// Built at the first call; the same object afterwards.
[[nodiscard]] const BuiltScene& built_scene(const std::string& name);

}  // namespace rtu::bench
