#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "model/vec3.hpp"

namespace rtu::model {

/// Elements that an accessor without a buffer view (all zeros, or sparse only) may have: no bytes in the file
/// vouch for its count, so a few characters could claim any amount of memory.
inline constexpr std::uint64_t max_dataless_elements = std::uint64_t(1) << 24;

/// What an accessor holds for a primitive.
enum class AccessorUse : std::uint8_t { Positions, Indices };

/// The number of elements of accessor `index`, after checking that it exists, has the component type that its
/// use asks for, and that all of its bytes are in the file. Allocates nothing. Throws Error, which starts
/// with `where`.
[[nodiscard]] std::uint64_t checked_count(const tinygltf::Model& model, int index, AccessorUse use,
                                          const std::string& where);

/// The positions of accessor `index`, sparse elements in place. Throws Error as above, and for NaN or
/// infinity.
[[nodiscard]] std::vector<Vec3> read_positions(const tinygltf::Model& model, int index,
                                               const std::string& where);

/// The vertex indices of accessor `index`, 8, 16 or 32 bits wide in the file. Throws Error as above.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int index,
                                                      const std::string& where);

}  // namespace rtu::model
