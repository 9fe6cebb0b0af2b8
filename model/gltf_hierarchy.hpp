#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "model/affine.hpp"

namespace rtu::model {

/// A mesh, and where a node puts it.
struct MeshInstance {
    std::size_t mesh = 0;  ///< exists in the model
    Affine to_world;
};

/// The meshes of the default scene (without one: of the first scene; without scenes: of all root nodes),
/// depth-first, children in file order. Throws Error, which starts with `name`, for a scene, node or mesh
/// that does not exist, a node that is reached twice (so a cycle too), and a transform that is not affine.
[[nodiscard]] std::vector<MeshInstance> mesh_instances(const tinygltf::Model& model, const std::string& name);

}  // namespace rtu::model
