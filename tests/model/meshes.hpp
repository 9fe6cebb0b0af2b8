#pragma once

// Small meshes and random numbers that several tests share.

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <ostream>
#include <random>

#include "model/bvh.hpp"
#include "model/mesh.hpp"
#include "model/pairing.hpp"

namespace rtu::model {

/// How a test's name shows its parameter.
inline void PrintTo(const BvhOptions& options, std::ostream* out) {
    *out << options.width << " wide, " << options.max_leaf_pairs << " pairs a leaf"
         << (options.splits == SplitKind::Spatial ? ", spatial splits" : "");
}

}  // namespace rtu::model

namespace rtu::test {

using model::MemoryImage;
using model::TriangleMesh;
using model::Vec3;

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    /// Uniform in [lo, hi).
    float uniform(float lo, float hi) { return lo + (hi - lo) * float(engine_() >> 8) * 0x1p-24F; }
    Vec3 point(float lo, float hi) { return {uniform(lo, hi), uniform(lo, hi), uniform(lo, hi)}; }
    std::uint32_t below(std::uint32_t n) { return std::uint32_t(engine_() % n); }

  private:
    std::mt19937 engine_;
};

/// Triangles with corners anywhere in the unit cube: no two share anything.
inline TriangleMesh triangle_soup(std::uint32_t count, std::uint32_t seed, float size = 1.0F) {
    Random random(seed);
    TriangleMesh mesh{"soup", {}, {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 centre = random.point(0, 1);
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(centre + random.point(-size, size));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// Triangles as long as a cube of 2 about `centre` and as thin as a thousandth of it, at any angle: what
/// spatial splits are for.
inline TriangleMesh needles(std::uint32_t count, std::uint32_t seed, Vec3 centre) {
    Random random(seed);
    TriangleMesh mesh{"needles", {}, {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 a = centre + random.point(-1, 1), b = centre + random.point(-1, 1);
        for (const Vec3 p : {a, b, a + random.point(-1, 1) * 0.001F}) mesh.positions.push_back(p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// A closed sphere about `centre` with poles of valence 2 * rings; every edge belongs to exactly two
/// triangles.
inline TriangleMesh closed_sphere(std::uint32_t rings, Vec3 centre, float radius) {
    const std::uint32_t sectors = 2 * rings;
    TriangleMesh mesh{"sphere", {centre + Vec3{0, radius, 0}, centre - Vec3{0, radius, 0}}, {}};
    const auto vertex = [=](std::uint32_t ring, std::uint32_t sector) {
        if (ring == 0) return 0U;
        if (ring == rings) return 1U;
        return 2 + (ring - 1) * sectors + sector % sectors;
    };
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const double theta = std::numbers::pi * ring / rings,
                         phi = 2 * std::numbers::pi * sector / sectors;
            const Vec3 unit{float(std::sin(theta) * std::cos(phi)), float(std::cos(theta)),
                            float(std::sin(theta) * std::sin(phi))};
            mesh.positions.push_back(centre + unit * radius);
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = vertex(ring, sector), b = vertex(ring, sector + 1);
            const std::uint32_t c = vertex(ring + 1, sector), d = vertex(ring + 1, sector + 1);
            if (ring > 0) mesh.triangles.push_back({a, b, c});
            if (ring + 1 < rings) mesh.triangles.push_back({b, d, c});
        }
    }
    return mesh;
}

/// A closed axis-aligned box [lo, hi] whose six faces are n x n grids of two triangles a cell, vertices
/// shared.
inline TriangleMesh closed_box(std::uint32_t n, Vec3 lo, Vec3 hi) {
    TriangleMesh mesh{"box", {}, {}};
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> ids;
    const auto vertex = [&](std::array<std::uint32_t, 3> cell) {
        const auto [entry, is_new] = ids.try_emplace(cell, std::uint32_t(mesh.positions.size()));
        if (is_new) {
            Vec3 p;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                p[axis] = lo[axis] + (hi[axis] - lo[axis]) * (float(cell[axis]) / float(n));
            }
            mesh.positions.push_back(p);
        }
        return entry->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::uint32_t level : {0U, n}) {
            for (std::uint32_t i = 0; i < n; ++i) {
                for (std::uint32_t j = 0; j < n; ++j) {
                    const auto corner = [&](std::uint32_t di, std::uint32_t dj) {
                        std::array<std::uint32_t, 3> cell{};
                        cell[axis] = level;
                        cell[(axis + 1) % 3] = i + di;
                        cell[(axis + 2) % 3] = j + dj;
                        return vertex(cell);
                    };
                    const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                                        d = corner(0, 1);
                    if (level == 0) {
                        mesh.triangles.push_back({a, c, b});
                        mesh.triangles.push_back({a, d, c});
                    } else {
                        mesh.triangles.push_back({a, b, c});
                        mesh.triangles.push_back({a, c, d});
                    }
                }
            }
        }
    }
    return mesh;
}

/// Pairs and builds in one go.
inline MemoryImage image_of(const TriangleMesh& mesh, model::BvhOptions options = {},
                            model::PairingMethod method = {model::PairingKind::EdgeBbsa, 0}) {
    return build_bvh(mesh, pair_triangles(mesh, method, model::EdgeIdentity::Position), options);
}

}  // namespace rtu::test
