#pragma once

#include <cstdint>
#include <filesystem>

#include "model/mesh.hpp"

namespace rtu::model {

/// The most triangles, and the most vertices, that a scene may have once its instances are flattened: more
/// triangles than the memory image can address anyway.
inline constexpr std::uint64_t max_scene_elements = std::uint64_t(1) << 28;

/// Reads every triangle of the default scene of a glTF 2.0 file (.gltf or .glb), in world space: node
/// transforms applied, instanced meshes flattened, triangle strips and fans and non-indexed primitives turned
/// into index triples, sparse accessors resolved. Points and lines are skipped; skins, morph targets and
/// animations are not applied. A mirroring transform swaps the last two corners, so that the winding still
/// faces outwards. The mesh is named after the file, without its extension. Throws Error, in one line with
/// the file's name, for anything that cannot be read in full, for a scene without a triangle that has an
/// area, and for one beyond max_coordinate or below min_diagonal.
[[nodiscard]] TriangleMesh load_gltf(const std::filesystem::path& file);

}  // namespace rtu::model
