#include "study/stability/stability_mesh.hpp"

#include <array>
#include <cmath>
#include <map>

#include "model/builtin_sculptures.hpp"
#include "model/error.hpp"
#include "model/mesh_builder.hpp"
#include "model/random.hpp"
#include "model/unit_circle.hpp"

namespace rtu::study {
namespace {

using model::CirclePoint;
using model::MeshBuilder;
using model::TriangleMesh;
using model::Vec3;

TriangleMesh of_four(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return {"", {a, b, c, d}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}
TriangleMesh tetrahedron() { return of_four({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}); }
TriangleMesh flat_tetrahedron() {
    return of_four({0.9F, 0.003F, 0.1F}, {0.2F, -0.004F, -0.8F}, {-0.7F, 0.005F, -0.3F},
                   {-0.1F, -0.006F, 0.9F});
}
TriangleMesh cube() { return box_grid(1); }
TriangleMesh box() { return box_grid(4); }

// Rings of vertices between two poles, which every sector meets.
template <class Ring>
TriangleMesh of_rings(std::uint32_t rings, std::uint32_t sectors, float pole, const Ring& ring) {
    MeshBuilder mesh;
    const std::uint32_t top = mesh.add_vertex({0, pole, 0}), bottom = mesh.add_vertex({0, -pole, 0});
    const std::vector<CirclePoint> circle = model::unit_circle(sectors);
    for (std::uint32_t i = 0; i < rings; ++i) {
        const auto [radius, height] = ring(i);
        for (const CirclePoint& p : circle) mesh.add_vertex({radius * p.sine, height, radius * p.cosine});
    }
    const auto vertex = [&](std::uint32_t i, std::uint32_t sector) {
        return 2 + i * sectors + sector % sectors;
    };
    for (std::uint32_t s = 0; s < sectors; ++s) {
        mesh.add_triangle(top, vertex(0, s), vertex(0, s + 1));
        for (std::uint32_t i = 0; i + 1 < rings; ++i) {
            mesh.add_quad(vertex(i, s), vertex(i + 1, s), vertex(i + 1, s + 1), vertex(i, s + 1));
        }
        mesh.add_triangle(bottom, vertex(rings - 1, s + 1), vertex(rings - 1, s));
    }
    return mesh.take();
}

TriangleMesh ball() {
    constexpr std::uint32_t rings = 7, sectors = 16;
    const std::vector<CirclePoint> turn = model::unit_circle(2 * (rings + 1));
    return of_rings(rings, sectors, 1,
                    [&](std::uint32_t i) { return std::pair(turn[i + 1].sine, turn[i + 1].cosine); });
}

template <std::uint32_t Sectors>
TriangleMesh fan() {
    return of_rings(1, Sectors, 0.5F, [](std::uint32_t) { return std::pair(1.0F, 0.0F); });
}
TriangleMesh needles() {
    return of_rings(1, 64, 1, [](std::uint32_t) { return std::pair(0.01F, 0.0F); });
}

TriangleMesh icosphere() { return model::icosphere(2); }
TriangleMesh coral() { return model::coral(2); }

TriangleMesh spiky() {
    TriangleMesh mesh = model::icosphere(2);
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = mesh.positions[i] * (0.3F + 0.7F * model::RandomStream(1, 0, i).next());
    }
    return mesh;
}

TriangleMesh torus() {
    constexpr std::uint32_t steps = 16, sides = 8;
    const std::vector<CirclePoint> turn = model::unit_circle(steps), section = model::unit_circle(sides);
    MeshBuilder mesh;
    for (const CirclePoint& around : turn) {
        for (const CirclePoint& p : section) {
            const float radius = 0.7F + 0.3F * p.cosine;
            mesh.add_vertex({radius * around.sine, 0.3F * p.sine, radius * around.cosine});
        }
    }
    const auto vertex = [](std::uint32_t i, std::uint32_t j) { return i % steps * sides + j % sides; };
    for (std::uint32_t i = 0; i < steps; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            mesh.add_quad(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
        }
    }
    return mesh.take();
}

constexpr std::array<ClosedMesh, 13> meshes{{
    {"tetrahedron", "a regular tetrahedron", 0.5F, tetrahedron},
    {"flat_tetrahedron", "a tetrahedron 1/100 as high as wide", 0.0001F, flat_tetrahedron},
    {"cube", "12 triangles, axis-aligned", 0.9F, cube},
    {"box_grid", "a box of 4 x 4 squares a face, axis-aligned", 0.9F, box},
    {"ball", "16 sectors, 8 rings", 0.7F, ball},
    {"fan_16", "a double cone, poles of valence 16", 0.3F, fan<16>},
    {"fan_128", "a double cone, poles of valence 128", 0.3F, fan<128>},
    {"fan_1024", "a double cone, poles of valence 1,024", 0.3F, fan<1024>},
    {"needles", "a double cone 100 times as high as wide, 64 sectors", 0.005F, needles},
    {"icosphere", "320 nearly equilateral triangles", 0.7F, icosphere},
    {"spiky", "an icosphere whose vertices are 0.3 to 1 from its centre", 0.1F, spiky},
    {"coral", "an icosphere under ridged noise", 0.3F, coral},
    {"torus", "not around the origin: rays from there cross it an even number of times", 0, torus},
}};

}  // namespace

std::span<const ClosedMesh> closed_meshes() { return meshes; }

const ClosedMesh& closed_mesh(std::string_view name) {
    for (const ClosedMesh& mesh : meshes) {
        if (mesh.name == name) return mesh;
    }
    throw std::logic_error("no closed mesh '" + std::string(name) + "'");
}

TriangleMesh box_grid(std::uint32_t count) {
    MeshBuilder mesh;
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> vertices;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::uint32_t level : {0U, count}) {
            const auto corner = [&](std::uint32_t i, std::uint32_t j) {
                std::array<std::uint32_t, 3> place{};
                place[axis] = level;
                place[(axis + 1) % 3] = i;
                place[(axis + 2) % 3] = j;
                const auto known = vertices.find(place);
                if (known != vertices.end()) return known->second;
                Vec3 p;
                for (std::size_t k = 0; k < 3; ++k) p[k] = 2 * float(place[k]) / float(count) - 1;
                return vertices[place] = mesh.add_vertex(p);
            };
            for (std::uint32_t i = 0; i < count; ++i) {
                for (std::uint32_t j = 0; j < count; ++j) {
                    const auto a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                               d = corner(i, j + 1);
                    if (level == 0) {
                        mesh.add_quad(a, d, c, b);
                    } else {
                        mesh.add_quad(a, b, c, d);
                    }
                }
            }
        }
    }
    return mesh.take();
}

}  // namespace rtu::study
