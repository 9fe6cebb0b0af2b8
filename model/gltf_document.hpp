#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace rtu::model {

/// Reads a .gltf or .glb file into tinygltf's structures, buffers included; images, materials and animations
/// are left out. Sizes and offsets are not yet checked against each other: gltf_accessor.hpp does that.
/// Throws Error for anything that is wrong before that.
[[nodiscard]] tinygltf::Model load_gltf_document(const std::filesystem::path& file);

}  // namespace rtu::model
