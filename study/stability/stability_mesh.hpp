#pragma once

#include <span>
#include <string_view>

#include "model/mesh.hpp"

namespace rtu::study {

/// A closed surface made in code, about 1 in size around the origin, wound counter-clockwise from outside,
/// every edge between two triangles.
struct ClosedMesh {
    std::string_view name;
    std::string_view title;
    /// From every point at most this far from the origin, whatever the direction, a ray crosses the surface
    /// an odd number of times.
    float inner_radius;
    model::TriangleMesh (*make)();
};

/// All of them, small ones: 4 to 2,048 triangles.
[[nodiscard]] std::span<const ClosedMesh> closed_meshes();

/// Throws std::logic_error for a name that is not there.
[[nodiscard]] const ClosedMesh& closed_mesh(std::string_view name);

/// A box [-1, 1]^3 whose faces are grids of count x count squares, each of two triangles.
[[nodiscard]] model::TriangleMesh box_grid(std::uint32_t count);

}  // namespace rtu::study
