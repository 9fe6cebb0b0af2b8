#include "model/mesh_builder.hpp"

#include <utility>

#include "model/random.hpp"

namespace rtu::model {

std::uint32_t MeshBuilder::add_vertex(Vec3 position) {
    mesh_.positions.push_back(position);
    return std::uint32_t(mesh_.positions.size() - 1);
}

void MeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({a, b, c});
}

void MeshBuilder::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
}

void MeshBuilder::add_flat_quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const std::uint32_t first = add_vertex(a);
    add_vertex(b);
    add_vertex(c);
    add_vertex(d);
    add_quad(first, first + 1, first + 2, first + 3);
}

void MeshBuilder::add_hexahedron(const std::array<Vec3, 8>& corners) {
    constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& [a, b, c, d] : faces) {
        add_flat_quad(corners[a], corners[b], corners[c], corners[d]);
    }
}

void MeshBuilder::add_box(Vec3 lo, Vec3 hi) {
    std::array<Vec3, 8> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = {(k & 1U) != 0 ? hi.x : lo.x, (k & 2U) != 0 ? hi.y : lo.y, (k & 4U) != 0 ? hi.z : lo.z};
    }
    add_hexahedron(corners);
}

void MeshBuilder::add_mesh(const TriangleMesh& mesh) {
    const auto first = std::uint32_t(mesh_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& [a, b, c] : mesh.triangles) {
        add_triangle(first + a, first + b, first + c);
    }
}

TriangleMesh MeshBuilder::take() { return std::exchange(mesh_, {}); }

TriangleMesh placed(TriangleMesh mesh, float scale, Vec3 offset) {
    for (Vec3& position : mesh.positions) {
        position = position * scale + offset;
    }
    return mesh;
}

TriangleMesh shuffled(TriangleMesh mesh, std::uint32_t seed) {
    for (auto i = std::uint32_t(mesh.triangles.size()); i > 1; --i) {
        const std::uint32_t bits = philox({i, 0, 0, 0}, {seed, 0})[0];
        const auto j = std::uint32_t(std::uint64_t(bits) * i >> 32U);  // in [0, i)
        std::swap(mesh.triangles[i - 1], mesh.triangles[j]);
    }
    return mesh;
}

TriangleMesh with_split_vertices(const TriangleMesh& mesh) {
    TriangleMesh split;
    for (const Triangle& triangle : mesh.triangles) {
        const auto first = std::uint32_t(split.positions.size());
        for (const std::uint32_t vertex : triangle) {
            split.positions.push_back(mesh.positions[vertex]);
        }
        split.triangles.push_back({first, first + 1, first + 2});
    }
    return split;
}

}  // namespace rtu::model
