#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/aabb.hpp"

namespace rtu::model {

/// The largest coordinate of a scene or camera, and the least diagonal of a scene's box, in scene units:
/// beyond them binary32 arithmetic on positions, such as that of normals and areas, overflows or underflows.
inline constexpr float max_coordinate = 1e11F;
inline constexpr float min_diagonal = 1e-9F;

/// Three indices into the vertex positions, in the file's winding order.
using Triangle = std::array<std::uint32_t, 3>;

/// A scene's geometry in world space. Triangle order, vertex indices and degenerate triangles are the file's.
/// Invariants (whoever fills one checks them): every index < positions.size(), every position finite.
struct TriangleMesh {
    std::string name;
    std::vector<Vec3> positions;      ///< [vertex_count]
    std::vector<Triangle> triangles;  ///< [triangle_count]
};

/// Box around the triangles' corners (vertices that no triangle uses do not count); empty for no triangles.
[[nodiscard]] Aabb bounds(const TriangleMesh& mesh);

/// True for a triangle of exactly zero area: two corners at one place, or three on one line.
[[nodiscard]] bool is_degenerate(const TriangleMesh& mesh, const Triangle& triangle);

/// Number of degenerate triangles.
[[nodiscard]] std::uint64_t count_degenerate(const TriangleMesh& mesh);

}  // namespace rtu::model
