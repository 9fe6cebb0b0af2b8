#include "model/builtin_sculptures.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "model/mesh_builder.hpp"
#include "model/unit_circle.hpp"
#include "model/value_noise.hpp"

namespace rtu::model {

namespace {

TriangleMesh icosahedron() {
    const float golden = (1.0F + std::sqrt(5.0F)) * 0.5F;
    TriangleMesh mesh;
    mesh.positions = {{-1, golden, 0}, {1, golden, 0}, {-1, -golden, 0}, {1, -golden, 0},
                      {0, -1, golden}, {0, 1, golden}, {0, -1, -golden}, {0, 1, -golden},
                      {golden, 0, -1}, {golden, 0, 1}, {-golden, 0, -1}, {-golden, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3& position : mesh.positions) {
        position = normalized(position);
    }
    return mesh;
}

/// Cuts every triangle in four and puts the new vertices on the unit sphere.
TriangleMesh subdivided(const TriangleMesh& coarse) {
    TriangleMesh fine;
    fine.positions = coarse.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] =
            midpoints.try_emplace({std::min(a, b), std::max(a, b)}, std::uint32_t(fine.positions.size()));
        if (is_new) {
            fine.positions.push_back(normalized(coarse.positions[a] + coarse.positions[b]));
        }
        return found->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const std::uint32_t ab = midpoint(a, b);
        const std::uint32_t bc = midpoint(b, c);
        const std::uint32_t ca = midpoint(c, a);
        fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

/// The knot's centre line at step i, and the direction away from the core circle of its torus.
struct KnotPoint {
    Vec3 position;
    Vec3 outward;
};

KnotPoint knot_point(const std::vector<CirclePoint>& circle, std::size_t i) {
    const CirclePoint around = circle[2 * i % circle.size()];
    const CirclePoint across = circle[3 * i % circle.size()];
    const Vec3 outward{across.cosine * around.cosine, across.sine, across.cosine * around.sine};
    return {Vec3{2.0F * around.cosine, 0, 2.0F * around.sine} + outward, outward};
}

}  // namespace

TriangleMesh icosphere(int levels) {
    TriangleMesh mesh = icosahedron();
    for (int level = 0; level < levels; ++level) {
        mesh = subdivided(mesh);
    }
    return mesh;
}

TriangleMesh coral(int levels) {
    constexpr float noise_scale = 2.3F;
    TriangleMesh mesh = icosphere(levels);
    for (Vec3& position : mesh.positions) {
        position = position * (0.62F + 0.62F * ridged_noise(position * noise_scale, 3));
    }
    return mesh;
}

TriangleMesh torus_knot() {
    constexpr std::uint32_t steps = 512;
    constexpr std::uint32_t sides = 16;
    constexpr float radius = 0.42F;
    const std::vector<CirclePoint> turn = unit_circle(steps);
    const std::vector<CirclePoint> section = unit_circle(sides);
    MeshBuilder mesh;
    for (std::uint32_t i = 0; i < steps; ++i) {
        const KnotPoint here = knot_point(turn, i);
        const Vec3 along = knot_point(turn, i + 1).position - knot_point(turn, i + steps - 1).position;
        const Vec3 side = normalized(cross(along, here.outward));
        const Vec3 out = normalized(cross(side, along));
        for (const CirclePoint& p : section) {
            mesh.add_vertex(here.position + radius * (p.cosine * out + p.sine * side));
        }
    }
    for (std::uint32_t i = 0; i < steps; ++i) {
        const std::uint32_t ring = i * sides;
        const std::uint32_t next_ring = (i + 1) % steps * sides;
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t next = (j + 1) % sides;
            mesh.add_quad(ring + j, ring + next, next_ring + next, next_ring + j);
        }
    }
    return mesh.take();
}

}  // namespace rtu::model
