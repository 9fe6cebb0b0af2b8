#pragma once

#include <array>
#include <cstdint>

#include "model/mesh.hpp"

namespace rtu::model {

/// Collects the triangles of a procedural mesh.
class MeshBuilder {
  public:
    /// Returns the new vertex's index.
    std::uint32_t add_vertex(Vec3 position);
    /// A triangle of existing vertices.
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    /// A quad of existing vertices, counter-clockwise from outside: triangles (a, b, c) and (a, c, d).
    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
    /// A quad with four vertices of its own: faces that share no vertex, as exporters with flat normals
    /// write.
    void add_flat_quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
    /// An axis-aligned box of six flat quads.
    void add_box(Vec3 lo, Vec3 hi);
    /// A hexahedron of six flat quads; corner k is at x, y, z = low or high by bits 0, 1, 2 of k.
    void add_hexahedron(const std::array<Vec3, 8>& corners);
    /// Appends the whole of another mesh.
    void add_mesh(const TriangleMesh& mesh);

    [[nodiscard]] TriangleMesh take();

  private:
    TriangleMesh mesh_;
};

/// The mesh scaled, then moved by `offset`.
[[nodiscard]] TriangleMesh placed(TriangleMesh mesh, float scale, Vec3 offset);

/// The mesh with its triangles in an order drawn at random: what some exporters and simplifiers leave behind.
[[nodiscard]] TriangleMesh shuffled(TriangleMesh mesh, std::uint32_t seed);

/// The mesh with three vertices of its own for every triangle, as in STL files.
[[nodiscard]] TriangleMesh with_split_vertices(const TriangleMesh& mesh);

}  // namespace rtu::model
