#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rtu::model {

// A glTF file is either JSON text, or a GLB (little-endian):
//   uint32 magic "glTF", version 2, length of the whole file in bytes
//   then chunks: uint32 length, uint32 type, `length` bytes; the first is JSON, the second may be BIN, others
//   are ignored

/// The two parts of a glTF file.
struct GltfContainer {
    std::string json;
    std::vector<unsigned char> binary_chunk;  ///< empty when there is none
};

/// Reads a .gltf or .glb file, told apart by content. Throws Error for a file that is missing, no regular
/// file, unreadable, empty, neither format, not version 2, or shorter than its header says. Reads no byte
/// twice and holds only one copy.
[[nodiscard]] GltfContainer read_gltf_container(const std::filesystem::path& file);

}  // namespace rtu::model
