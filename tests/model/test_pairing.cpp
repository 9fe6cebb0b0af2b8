#include <gtest/gtest.h>

#include "model/edge_bbsa.hpp"
#include "model/edge_ring.hpp"
#include "model/error.hpp"
#include "model/pairing.hpp"
#include "model/weld.hpp"
#include "tests/model/pairing_checks.hpp"
#include "tests/model/pairing_meshes.hpp"
#include "tests/model/reference_pairing.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

constexpr PairingMethod none{PairingKind::None, 0};
constexpr PairingMethod by_edge_bbsa{PairingKind::EdgeBbsa, 0};

PairingMethod window(std::uint32_t n) { return {PairingKind::Window, n}; }

class PairingOfChaos : public testing::TestWithParam<std::uint32_t> {};

TEST_P(PairingOfChaos, IsValidAndEqualsTheReference) {
    for (std::uint32_t seed = GetParam(); seed < GetParam() + 100; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = chaotic_mesh(seed);
        const std::size_t count = mesh.triangles.size();
        for (const EdgeIdentity identity : identities) {
            const Pairing best = pair_triangles(mesh, by_edge_bbsa, identity);
            expect_valid(mesh, best, identity);
            EXPECT_EQ(partners_of(best, count), reference_edge_bbsa(mesh, identity));
            for (const std::uint32_t n : {2U, 3U, 17U, max_pairing_window}) {
                const Pairing windowed = pair_triangles(mesh, window(n), identity);
                expect_valid(mesh, windowed, identity);
                EXPECT_EQ(partners_of(windowed, count), reference_window(mesh, n, identity)) << n;
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, PairingOfChaos, testing::Range(0U, 400U, 100U));

TEST(Pairing, OfAShuffledSheetEqualsTheReference) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const TriangleMesh mesh = split_sheet(20, seed);
        for (const EdgeIdentity identity : identities) {
            const Pairing pairing = pair_triangles(mesh, by_edge_bbsa, identity);
            expect_valid(mesh, pairing, identity);
            EXPECT_EQ(partners_of(pairing, mesh.triangles.size()), reference_edge_bbsa(mesh, identity));
            const Pairing windowed = pair_triangles(mesh, window(50), identity);
            expect_valid(mesh, windowed, identity);
            EXPECT_EQ(partners_of(windowed, mesh.triangles.size()), reference_window(mesh, 50, identity));
        }
    }
}

TEST(Pairing, OfAnEmptyMeshIsEmpty) {
    for (const PairingMethod method : all_methods()) {
        const Pairing pairing = pair_triangles({}, method, EdgeIdentity::Position);
        EXPECT_TRUE(pairing.pairs.empty());
        EXPECT_EQ(pairing.paired_percent(), 0.0);
    }
}

TEST(Pairing, NoneLeavesEveryTriangleAlone) {
    const Pairing pairing = pair_triangles(split_sheet(2, 1), none, EdgeIdentity::Index);
    EXPECT_EQ(pairing.single_count, 8U);
    EXPECT_EQ(pairing.pair_count, 0U);
}

TEST(Pairing, WindowLooksExactlyNMinusOneTrianglesAhead) {
    // Triangles 0 and 3 share an edge; 1 and 2 touch nothing.
    const TriangleMesh mesh{"", std::vector<Vec3>(10), {{0, 1, 2}, {4, 5, 6}, {7, 8, 9}, {2, 1, 3}}};
    EXPECT_EQ(pair_triangles(mesh, window(3), EdgeIdentity::Index).pair_count, 0U);
    EXPECT_EQ(pair_triangles(mesh, window(4), EdgeIdentity::Index).pair_count, 1U);
}

TEST(Pairing, WindowTakesTheFirstNeighbourAndNotTheLongestEdge) {
    const TriangleMesh mesh{
        "", {{0, 0, 0}, {1, 0, 0}, {0, 9, 9}, {1, 1, 0}, {5, 5, 5}}, {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}}};
    EXPECT_EQ(partners_of(pair_triangles(mesh, window(3), EdgeIdentity::Index), 3), (Partners{1, 0, {}}));
    EXPECT_EQ(partners_of(pair_triangles(mesh, by_edge_bbsa, EdgeIdentity::Index), 3), (Partners{2, {}, 0}));
}

TEST(Pairing, TiesGoToTheLowestVerticesThenTheLowestTriangles) {
    // Every edge has area 0: the greedy order is that of the vertices. Edge 0-1 has three half-edges.
    const TriangleMesh mesh{
        "", std::vector<Vec3>(6), {{3, 2, 4}, {0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 3, 5}}};
    EXPECT_EQ(partners_of(pair_triangles(mesh, by_edge_bbsa, EdgeIdentity::Index), 5),
              (Partners{4, 2, 1, {}, 0}));
}

TEST(Pairing, ASideWithoutLengthIsNoEdge) {
    const TriangleMesh mesh{"", {{0, 0, 0}, {1, 1, 1}, {2, 0, 2}}, {{0, 0, 1}, {0, 0, 2}}};
    for (const PairingMethod method : all_methods()) {
        EXPECT_EQ(pair_triangles(mesh, method, EdgeIdentity::Index).pair_count, 0U);
    }
}

TEST(Pairing, JoinsSplitVerticesByPositionOnly) {
    const TriangleMesh mesh{
        "", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {4, 3, 5}}};
    EXPECT_EQ(pair_triangles(mesh, by_edge_bbsa, EdgeIdentity::Index).pair_count, 0U);
    const Pairing pairing = pair_triangles(mesh, by_edge_bbsa, EdgeIdentity::Position);
    ASSERT_EQ(pairing.pair_count, 1U);
    EXPECT_EQ(pairing.pairs[0].vertices, (std::array<std::uint32_t, 4>{2, 0, 1, 5}));
}

TEST(Pairing, ManyTrianglesOnOneEdgeAreNotQuadratic) {
    constexpr std::uint32_t count = 300'000;
    TriangleMesh mesh;
    mesh.positions.resize(count + 2);
    for (std::uint32_t t = 0; t < count; ++t) mesh.triangles.push_back({0, 1, t + 2});
    for (const PairingMethod method : {window(max_pairing_window), by_edge_bbsa}) {
        EXPECT_EQ(pair_triangles(mesh, method, EdgeIdentity::Index).pair_count, count / 2);
    }
}

TEST(Pairing, AStripWhoseEdgesGrowAllAlongIsNotQuadratic) {
    // Every triangle but the last prefers the next one, so the strip is decided from its end.
    constexpr std::uint32_t count = 99'999;
    TriangleMesh mesh;
    for (std::uint32_t v = 0; v < count + 2; ++v) {
        mesh.positions.push_back({(v % 2 == 0 ? 1.0F : -1.0F) * float(v), float(v), 0});
    }
    for (std::uint32_t t = 0; t < count; ++t) mesh.triangles.push_back({t, t + 1, t + 2});
    const Partners partners = partners_of(pair_triangles(mesh, by_edge_bbsa, EdgeIdentity::Index), count);
    EXPECT_EQ(partners[0], std::nullopt);
    for (std::uint32_t t = 1; t < count; ++t) ASSERT_EQ(partners[t], t % 2 == 0 ? t - 1 : t + 1);
}

TEST(EdgeRings, GoRoundEveryEdgeInFileOrder) {
    // Edge 0-1 has four half-edges, 1-2 two, and one triangle has 0-1 twice.
    const TriangleMesh mesh{"", std::vector<Vec3>(5), {{0, 1, 2}, {2, 1, 3}, {1, 0, 4}, {0, 1, 0}}};
    const std::vector<std::uint32_t> ids{0, 1, 2, 3, 4};
    ScratchMemory memory(1 << 12);
    const EdgeRings rings({mesh.triangles, mesh.positions, ids}, memory);
    const std::vector<std::uint32_t> next{6, 3, 2, 1, 4, 5, 9, 7, 8, 10, 0, 11};
    for (std::uint32_t h = 0; h < next.size(); ++h) {
        EXPECT_EQ(rings.next({h}).index, next[h]) << h;
        EXPECT_EQ(rings.is_crowded({h}), h == 0 || h == 6 || h == 9 || h == 10) << h;
    }
    EXPECT_EQ(rings.previous({0}), std::nullopt);
    EXPECT_EQ(rings.previous({6}), HalfEdge{0});
    EXPECT_EQ(rings.previous({9}), HalfEdge{6});
    EXPECT_EQ(rings.previous({10}), HalfEdge{9});
    EXPECT_EQ(rings.previous({1}), std::nullopt);
}

TEST(EdgeBoxArea, IsSymmetricAndNeverNan) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(edge_box_area({0, 0, 0}, {1, 2, 3}), 11.0F);
    EXPECT_EQ(edge_box_area({1, 2, 3}, {0, 0, 0}), 11.0F);
    EXPECT_EQ(edge_box_area({5, 5, 5}, {5, 5, 9}), 0.0F);
    EXPECT_EQ(edge_box_area({-3e38F, 0, 0}, {3e38F, 0, 0}), inf) << "an infinite extent times zero";
    EXPECT_EQ(edge_box_area({0, 0, 0}, {1e20F, 1e20F, 0}), inf);
}

TEST(Weld, GivesTheLowestVertexOfEveryPosition) {
    const std::vector<Vec3> positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {-0.0F, 0, 0}, {0, 0, 0}, {3, 2, 1}};
    ScratchMemory memory(1 << 12);
    const auto first = weld_positions(positions, memory);
    EXPECT_EQ(std::vector(first.begin(), first.end()), (std::vector<std::uint32_t>{0, 1, 0, 3, 1, 5}));
}

TEST(PairingMethod, RoundTripsThroughItsName) {
    for (const PairingMethod method : all_methods()) {
        EXPECT_EQ(parse_pairing_method(to_string(method)), method);
    }
    EXPECT_EQ(to_string(parse_pairing_method("window:65536")), "window:65536");
    for (const char* name : {"index", "position"}) EXPECT_EQ(to_string(parse_edge_identity(name)), name);
}

TEST(PairingMethod, RefusesEverythingElse) {
    for (const char* name :
         {"", "None", "window", "window:", "window:1", "window:65537", "window:-2", "window:2x", "window: 2",
          "window:+2", "window:99999999999999999999", "edge_bbsa "}) {
        EXPECT_THROW((void)parse_pairing_method(name), Error) << name;
    }
    EXPECT_THROW((void)parse_edge_identity("both"), Error);
}

}  // namespace
}  // namespace rtu::test
