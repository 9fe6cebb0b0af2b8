#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "model/builtin_hall.hpp"
#include "model/builtin_scene.hpp"
#include "model/builtin_sculptures.hpp"
#include "model/camera.hpp"
#include "model/mesh_builder.hpp"
#include "model/unit_circle.hpp"

namespace rtu::model {
namespace {

/// FNV-1a over the bits of all positions and indices, word by word.
std::uint64_t fingerprint(const TriangleMesh& mesh) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 0x100000001b3; };
    for (const Vec3 p : mesh.positions) {
        add(std::bit_cast<std::uint32_t>(p.x));
        add(std::bit_cast<std::uint32_t>(p.y));
        add(std::bit_cast<std::uint32_t>(p.z));
    }
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            add(vertex);
        }
    }
    return hash;
}

std::size_t distinct_positions(const TriangleMesh& mesh) {
    std::set<std::tuple<float, float, float>> distinct;
    for (const Vec3 p : mesh.positions) {
        distinct.emplace(p.x, p.y, p.z);
    }
    return distinct.size();
}

int common_vertices(const Triangle& a, const Triangle& b) {
    int count = 0;
    for (const std::uint32_t vertex : a) {
        count += vertex == b[0] || vertex == b[1] || vertex == b[2] ? 1 : 0;
    }
    return count;
}

/// Share of the triangles that find a partner by looking only at the next triangle of the file.
double paired_in_order(const TriangleMesh& mesh) {
    std::size_t paired = 0;
    for (std::size_t i = 1; i < mesh.triangles.size(); ++i) {
        if (common_vertices(mesh.triangles[i - 1], mesh.triangles[i]) >= 2) {
            paired += 2;
            ++i;
        }
    }
    return double(paired) / double(mesh.triangles.size());
}

/// Every edge of a closed, consistently wound surface is walked once in each direction.
bool is_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const auto& [a, b, c] : mesh.triangles) {
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            balance[{from, to}] += 1;
            balance[{to, from}] -= 1;
        }
    }
    for (const auto& [edge, count] : balance) {
        if (count != 0) {
            return false;
        }
    }
    return true;
}

TEST(BuiltinScene, HasTheSizeThatTheInterfacePromises) {
    const TriangleMesh mesh = builtin_scene();
    EXPECT_EQ(mesh.name, "builtin");
    EXPECT_GE(mesh.triangles.size(), 100'000U);
    EXPECT_LE(mesh.triangles.size(), 300'000U);
}

TEST(BuiltinScene, IsTheSameBitForBitOnEveryMachine) {
    // A golden value: it changes only when the scene is changed on purpose, and then every published figure
    // does.
    EXPECT_EQ(fingerprint(builtin_scene()), std::uint64_t{5590981110051572071});
}

TEST(BuiltinScene, EveryPositionIsFiniteAndEveryIndexInRange) {
    const TriangleMesh mesh = builtin_scene();
    for (const Vec3 p : mesh.positions) {
        ASSERT_TRUE(is_finite(p));
    }
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            ASSERT_LT(vertex, mesh.positions.size());
        }
    }
}

TEST(BuiltinScene, DegenerateTrianglesAreTheSlatSeamsAndTheRibbonEndsOnly) {
    constexpr std::uint64_t slats = std::uint64_t{12} * 16;
    constexpr std::uint64_t ribbon_ends = 600 / 6;
    EXPECT_EQ(count_degenerate(builtin_hall()), slats);
    EXPECT_EQ(count_degenerate(hairball()), ribbon_ends);
    EXPECT_EQ(count_degenerate(builtin_scene()), slats + ribbon_ends);
}

TEST(BuiltinScene, ManyVerticesShareAPositionButNotAnIndex) {
    const TriangleMesh mesh = builtin_scene();
    EXPECT_LT(double(distinct_positions(mesh)), 0.75 * double(mesh.positions.size()));
}

TEST(BuiltinScene, HairballIsInStripOrderAndSculpturesAreNot) {
    EXPECT_GT(paired_in_order(hairball()), 0.99);
    EXPECT_EQ(paired_in_order(torus_knot()), 1.0);
    EXPECT_LT(paired_in_order(shuffled(torus_knot(), 2)), 0.01);
    EXPECT_LT(paired_in_order(shuffled(coral(3), 1)), 0.01);
}

TEST(BuiltinScene, SculpturesAreClosed) {
    EXPECT_TRUE(is_closed(icosphere(3)));
    EXPECT_TRUE(is_closed(coral(3)));
    EXPECT_TRUE(is_closed(torus_knot()));
}

TEST(BuiltinScene, CameraStandsInTheHall) {
    const Camera camera = builtin_camera();
    const Aabb hall = bounds(builtin_hall());
    EXPECT_TRUE(hall.contains(camera.eye));
    EXPECT_TRUE(hall.contains(camera.target));
    EXPECT_NE(camera.eye, camera.target);
}

TEST(Icosphere, HasFourTimesTheTrianglesALevelOnTheUnitSphere) {
    for (int level = 0; level < 4; ++level) {
        const TriangleMesh mesh = icosphere(level);
        EXPECT_EQ(mesh.triangles.size(), 20U << 2U * unsigned(level));
        EXPECT_EQ(mesh.positions.size(), 2 + mesh.triangles.size() / 2);  // Euler: V - E + F = 2, E = 3 F / 2
        for (const Vec3 p : mesh.positions) {
            EXPECT_NEAR(length(p), 1.0F, 2e-7F);
        }
    }
}

TEST(UnitCircle, PointsAreEvenAndStartAtTheXAxis) {
    constexpr double pi = 3.14159265358979323846;
    const std::vector<CirclePoint> circle = unit_circle(64);
    ASSERT_EQ(circle.size(), 64U);
    for (std::size_t i = 0; i < circle.size(); ++i) {
        const double angle = 2 * pi * double(i) / 64;
        EXPECT_NEAR(circle[i].cosine, std::cos(angle), 3e-7);
        EXPECT_NEAR(circle[i].sine, std::sin(angle), 3e-7);
    }
}

TEST(MeshBuilder, BoxFacesOutwards) {
    MeshBuilder builder;
    builder.add_box({-1, -2, -3}, {1, 2, 3});
    const TriangleMesh box = builder.take();
    ASSERT_EQ(box.triangles.size(), 12U);
    for (const auto& [a, b, c] : box.triangles) {
        const Vec3 p = box.positions[a];
        EXPECT_GT(dot(cross(box.positions[b] - p, box.positions[c] - p), p), 0.0F);
    }
}

TEST(MeshBuilder, ShufflingKeepsEveryTriangleOnce) {
    const TriangleMesh mesh = icosphere(3);
    const TriangleMesh mixed = shuffled(mesh, 5);
    EXPECT_NE(mesh.triangles, mixed.triangles);
    EXPECT_EQ(std::multiset<Triangle>(mesh.triangles.begin(), mesh.triangles.end()),
              std::multiset<Triangle>(mixed.triangles.begin(), mixed.triangles.end()));
}

}  // namespace
}  // namespace rtu::model
