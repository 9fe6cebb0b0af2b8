#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace rtu::model {

/// The bytes of one glTF buffer, exactly `byteLength` of them.
using BufferBytes = std::vector<unsigned char>;

/// Loads every buffer that the checked `document` of `file` names: the GLB's binary chunk, a data URI, or a
/// file in the folder of `file`. Throws Error for a buffer that is missing or shorter than its byteLength, an
/// unknown kind of URI, and a file that lies outside the folder (absolute path, `..`, or a symbolic link that
/// leads out).
[[nodiscard]] std::vector<BufferBytes> load_gltf_buffers(const nlohmann::json& document,
                                                         BufferBytes binary_chunk,
                                                         const std::filesystem::path& file);

}  // namespace rtu::model
