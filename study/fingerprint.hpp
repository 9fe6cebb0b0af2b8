#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/mesh.hpp"

namespace rtu::study {

/// Tells whether two inputs are the same, as 16 hex digits of FNV-1a; no protection against deliberate
/// collisions.
[[nodiscard]] std::string fingerprint(std::string_view bytes);

/// The same of a mesh's triangles and positions; its name does not count.
[[nodiscard]] std::string fingerprint(const model::TriangleMesh& mesh);

}  // namespace rtu::study
