#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "model/mesh.hpp"

namespace rtu::test {

/// A number below `bound`, the same with every standard library.
inline std::uint32_t below(std::mt19937& random, std::uint32_t bound) {
    return std::uint32_t(std::uint64_t{random()} * bound >> 32);
}

inline void shuffle_triangles(model::TriangleMesh& mesh, std::mt19937& random) {
    for (std::uint32_t i = std::uint32_t(mesh.triangles.size()); i > 1; --i) {
        std::swap(mesh.triangles[i - 1], mesh.triangles[below(random, i)]);
    }
}

/// Triangles between random vertices at few places, so that non-manifold edges, duplicates, degenerate
/// triangles, equal positions, equal areas, overflowing areas and both zeros are all frequent.
inline model::TriangleMesh chaotic_mesh(std::uint32_t seed) {
    constexpr std::array<float, 8> coordinates{0.0F, -0.0F, 1.0F, -2.5F, 3.0F, 1e-30F, 3e38F, -3e38F};
    std::mt19937 random(seed);
    const std::uint32_t places = 2 + below(random, 7);
    model::TriangleMesh mesh;
    mesh.positions.resize(1 + below(random, 40));
    for (model::Vec3& p : mesh.positions) {
        p = {coordinates[below(random, places)], coordinates[below(random, places)],
             coordinates[below(random, places)]};
    }
    mesh.triangles.resize(below(random, 120));
    const auto vertex = [&] { return below(random, std::uint32_t(mesh.positions.size())); };
    for (model::Triangle& t : mesh.triangles) t = {vertex(), vertex(), vertex()};
    return mesh;
}

/// A bumpy sheet of 2 n^2 triangles with every vertex split per quad row (so that only positions join the
/// rows) and the triangles in random order.
inline model::TriangleMesh split_sheet(std::uint32_t n, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> heights(std::size_t{n + 1} * (n + 1));
    for (float& h : heights) h = float(below(random, 1000)) * 0.001F;
    model::TriangleMesh mesh;
    for (std::uint32_t row = 0; row < n; ++row) {
        const auto first = std::uint32_t(mesh.positions.size());
        for (std::uint32_t y = row; y < row + 2; ++y) {
            for (std::uint32_t x = 0; x <= n; ++x) {
                mesh.positions.push_back({float(x), heights[y * (n + 1) + x], float(y)});
            }
        }
        for (std::uint32_t a = first; a < first + n; ++a) {
            const std::uint32_t c = a + n + 1;
            mesh.triangles.push_back({a, a + 1, c + 1});
            mesh.triangles.push_back({a, c + 1, c});
        }
    }
    shuffle_triangles(mesh, random);
    return mesh;
}

/// A crumpled sheet of 2 n^2 triangles of many shapes: vertices off the grid, diagonals at random.
inline model::TriangleMesh jittered_sheet(std::uint32_t n, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto jitter = [&random] { return float(below(random, 900)) * 0.001F; };
    model::TriangleMesh mesh;
    for (std::uint32_t i = 0; i < (n + 1) * (n + 1); ++i) {
        const std::uint32_t column = i % (n + 1), row = i / (n + 1);
        const float x = jitter(), y = jitter(), z = jitter();
        mesh.positions.push_back({float(column) + x, y, float(row) + z});
    }
    for (std::uint32_t i = 0; i < n * n; ++i) {
        const std::uint32_t a = i / n * (n + 1) + i % n, b = a + 1, c = a + n + 1, d = c + 1;
        const bool is_falling = below(random, 2) == 0;
        mesh.triangles.push_back(is_falling ? model::Triangle{a, b, d} : model::Triangle{a, b, c});
        mesh.triangles.push_back(is_falling ? model::Triangle{a, d, c} : model::Triangle{b, d, c});
    }
    shuffle_triangles(mesh, random);
    return mesh;
}

}  // namespace rtu::test
