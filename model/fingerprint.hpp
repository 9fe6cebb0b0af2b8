#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"

namespace rtu::model {

/// Tells whether two inputs are the same: 64 bits of FNV-1a; no protection against deliberate collisions.
[[nodiscard]] std::uint64_t fingerprint(std::string_view bytes);

/// The same of a mesh's triangles and positions; its name does not count.
[[nodiscard]] std::uint64_t fingerprint(const TriangleMesh& mesh);

/// The same of an image's width and bytes.
[[nodiscard]] std::uint64_t fingerprint(const MemoryImage& image);

/// A fingerprint as reports show it: 16 hex digits.
[[nodiscard]] std::string hex_digits(std::uint64_t fingerprint);

}  // namespace rtu::model
