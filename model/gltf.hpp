#pragma once

#include <filesystem>

#include "model/mesh.hpp"

namespace rtu::model {

/// Reads every triangle of the default scene of a glTF 2.0 file (.gltf or .glb), in world space: node transforms
/// applied, instanced meshes flattened, triangle strips and fans and non-indexed primitives turned into index
/// triples, sparse accessors resolved. Points and lines are skipped.
/// Throws Error, in one line with the file's name, for anything that cannot be read in full.
[[nodiscard]] TriangleMesh load_gltf(const std::filesystem::path& file);

}  // namespace rtu::model
