#include <gtest/gtest.h>

#include <bit>

#include "model/edge_bbsa.hpp"
#include "model/error.hpp"
#include "model/pair_layout.hpp"
#include "model/pair_saving.hpp"
#include "model/pairing.hpp"
#include "model/weld.hpp"
#include "tests/model/pairing_meshes.hpp"
#include "tests/model/reference_pairing.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

constexpr PairingMethod none{PairingKind::None, 0};
constexpr PairingMethod edge_bbsa{PairingKind::EdgeBbsa, 0};
constexpr PairingMethod sa_exchange{PairingKind::SaExchange, 0};
constexpr PairingMethod sa_saving{PairingKind::SaSaving, 0};
constexpr std::array identities{EdgeIdentity::Index, EdgeIdentity::Position};

PairingMethod window(std::uint32_t n) { return {PairingKind::Window, n}; }

/// Everything that must hold for any mesh and method.
void expect_valid(const TriangleMesh& mesh, const Pairing& pairing, EdgeIdentity identity) {
    const std::vector<std::uint32_t> ids = identify(mesh, identity);
    const auto same = [&](const Triangle& a, const Triangle& b) {
        return ids[a[0]] == ids[b[0]] && ids[a[1]] == ids[b[1]] && ids[a[2]] == ids[b[2]];
    };
    std::vector<std::uint32_t> uses(mesh.triangles.size());
    std::optional<std::uint32_t> last;
    std::uint64_t pair_count = 0;
    for (const TrianglePair& pair : pairing.pairs) {
        const auto [first, second] = pair.primitive_ids;
        ASSERT_TRUE(first < mesh.triangles.size() && second < mesh.triangles.size());
        EXPECT_TRUE(!last || *last < first) << "not in the order of the first triangle";
        last = first;
        ++uses[first];
        EXPECT_EQ(file_corners(pair, 0), mesh.triangles[first]);
        EXPECT_TRUE(same(file_corners(pair, 1), mesh.triangles[second]));
        if (!pair.has_second) {
            EXPECT_EQ(first, second);
            EXPECT_EQ(pair.vertices[2], pair.vertices[3]);
            continue;
        }
        ++pair_count;
        ++uses[second];
        EXPECT_LT(first, second);
        EXPECT_NE(ids[pair.vertices[0]], ids[pair.vertices[2]]) << "the common edge is a point";
        EXPECT_TRUE(share_edge(mesh.triangles[first], mesh.triangles[second], ids));
    }
    EXPECT_EQ(uses, std::vector<std::uint32_t>(mesh.triangles.size(), 1));
    EXPECT_EQ(pairing.pair_count, pair_count);
    EXPECT_EQ(pairing.single_count, pairing.pairs.size() - pair_count);
}

/// The paper's mesh: these corners give every area of its table with dx dy in the plane.
TriangleMesh worked_example() {
    return {"worked example",
            {{0, 0, 0}, {7, 0, 0}, {4, 5, 0}, {-5, 4, 0}, {-2, 10, 0}, {6, 10, 0}},
            {{0, 1, 2}, {1, 5, 2}, {5, 4, 2}, {2, 4, 3}, {3, 0, 2}}};
}

std::span<const PairCandidate> candidates_of(const TriangleMesh& mesh, ScratchMemory& memory) {
    return edge_bbsa_candidates({mesh.triangles, mesh.positions, weld_positions(mesh.positions, memory)},
                                memory);
}

TEST(Pairing, SortsTheHalfEdgesOfTheWorkedExample) {
    const TriangleMesh mesh = worked_example();
    ScratchMemory memory(1 << 16);
    const auto candidates = candidates_of(mesh, memory);
    std::vector<std::array<std::uint32_t, 3>> columns;  // area and the two triangles
    for (const PairCandidate& c : candidates) {
        const float area = std::bit_cast<float>(~c.rank & 0x7fff'ffffU);
        columns.push_back({std::uint32_t(area), c.first.triangle(), c.second.triangle()});
    }
    const std::vector<std::array<std::uint32_t, 3>> twins_in_the_paper{
        {30, 2, 3}, {20, 0, 4}, {15, 0, 1}, {10, 1, 2}, {9, 3, 4}};
    EXPECT_EQ(columns, twins_in_the_paper);
}

TEST(Pairing, AcceptsAndRejectsAsInTheWorkedExample) {
    const TriangleMesh mesh = worked_example();
    ScratchMemory memory(1 << 16);
    const auto candidates = candidates_of(mesh, memory);
    Matching matching(5, memory);
    std::vector<bool> is_accepted;
    for (const PairCandidate& c : candidates) is_accepted.push_back(matching.try_pair(c.first, c.second));
    EXPECT_EQ(is_accepted, (std::vector<bool>{true, true, false, false, false}));

    const Pairing pairing = pair_triangles(mesh, edge_bbsa, EdgeIdentity::Index);
    EXPECT_EQ(partners_of(pairing, 5), (Partners{4, std::nullopt, 3, 2, 0}));
    EXPECT_DOUBLE_EQ(pairing.paired_percent(), 80.0);
}

TEST(Pairing, ReferenceGivesTheWholeTableOfTheWorkedExample) {
    const TriangleMesh mesh = worked_example();
    std::vector<float> areas;
    for (const HalfEdgeRecord& r : half_edge_table(mesh, identify(mesh, EdgeIdentity::Index))) {
        areas.push_back(r.area);
    }
    EXPECT_EQ(areas, (std::vector<float>{30, 30, 20, 20, 20, 18, 15, 15, 10, 10, 10, 9, 9, 0, 0}));
}

class PairingOfChaos : public testing::TestWithParam<std::uint32_t> {};

TEST_P(PairingOfChaos, IsValidAndEqualsTheReference) {
    for (std::uint32_t seed = GetParam(); seed < GetParam() + 100; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = chaotic_mesh(seed);
        const std::size_t count = mesh.triangles.size();
        for (const EdgeIdentity identity : identities) {
            const Pairing best = pair_triangles(mesh, edge_bbsa, identity);
            expect_valid(mesh, best, identity);
            EXPECT_EQ(partners_of(best, count), reference_edge_bbsa(mesh, identity));
            for (const std::uint32_t n : {2U, 3U, 17U, max_pairing_window}) {
                const Pairing windowed = pair_triangles(mesh, window(n), identity);
                expect_valid(mesh, windowed, identity);
                EXPECT_EQ(partners_of(windowed, count), reference_window(mesh, n, identity)) << n;
            }
            const Pairing saving = pair_triangles(mesh, sa_saving, identity);
            EXPECT_EQ(partners_of(saving, count), reference_sa_saving(mesh, identity));
            for (const PairingMethod method : {none, sa_saving, sa_exchange}) {
                expect_valid(mesh, pair_triangles(mesh, method, identity), identity);
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, PairingOfChaos, testing::Range(0U, 400U, 100U));

TEST(Pairing, OfAShuffledSheetEqualsTheReference) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const TriangleMesh mesh = split_sheet(20, seed);
        for (const EdgeIdentity identity : identities) {
            const Pairing pairing = pair_triangles(mesh, edge_bbsa, identity);
            expect_valid(mesh, pairing, identity);
            EXPECT_EQ(partners_of(pairing, mesh.triangles.size()), reference_edge_bbsa(mesh, identity));
            const Pairing windowed = pair_triangles(mesh, window(50), identity);
            expect_valid(mesh, windowed, identity);
            EXPECT_EQ(partners_of(windowed, mesh.triangles.size()), reference_window(mesh, 50, identity));
        }
    }
}

TEST(Pairing, IsTheSameEveryTime) {
    const TriangleMesh mesh = split_sheet(40, 1);
    for (const PairingMethod method : {window(9), edge_bbsa}) {
        const Pairing a = pair_triangles(mesh, method, EdgeIdentity::Position);
        const Pairing b = pair_triangles(mesh, method, EdgeIdentity::Position);
        ASSERT_EQ(a.pairs.size(), b.pairs.size());
        for (std::size_t i = 0; i < a.pairs.size(); ++i) {
            EXPECT_EQ(a.pairs[i].vertices, b.pairs[i].vertices);
            EXPECT_EQ(a.pairs[i].primitive_ids, b.pairs[i].primitive_ids);
            EXPECT_EQ(a.pairs[i].corner_order, b.pairs[i].corner_order);
        }
    }
}

TEST(Pairing, OfAnEmptyMeshIsEmpty) {
    for (const PairingMethod method : {none, window(2), edge_bbsa}) {
        const Pairing pairing = pair_triangles({}, method, EdgeIdentity::Position);
        EXPECT_TRUE(pairing.pairs.empty());
        EXPECT_EQ(pairing.paired_percent(), 0.0);
    }
}

TEST(Pairing, NoneLeavesEveryTriangleAlone) {
    const Pairing pairing = pair_triangles(worked_example(), none, EdgeIdentity::Index);
    EXPECT_EQ(pairing.single_count, 5U);
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
    EXPECT_EQ(partners_of(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Index), 3), (Partners{2, {}, 0}));
}

TEST(Pairing, TiesGoToTheLowestVerticesThenTheLowestTriangles) {
    // Every edge has area 0: the greedy order is that of the vertices. Edge 0-1 has three half-edges.
    const TriangleMesh mesh{
        "", std::vector<Vec3>(6), {{3, 2, 4}, {0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 3, 5}}};
    EXPECT_EQ(partners_of(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Index), 5),
              (Partners{4, 2, 1, {}, 0}));
}

TEST(Pairing, ASideWithoutLengthIsNoEdge) {
    const TriangleMesh mesh{"", {{0, 0, 0}, {1, 1, 1}, {2, 0, 2}}, {{0, 0, 1}, {0, 0, 2}}};
    for (const PairingMethod method : {window(2), edge_bbsa}) {
        EXPECT_EQ(pair_triangles(mesh, method, EdgeIdentity::Index).pair_count, 0U);
    }
}

TEST(Pairing, JoinsSplitVerticesByPositionOnly) {
    const TriangleMesh mesh{
        "", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {4, 3, 5}}};
    EXPECT_EQ(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Index).pair_count, 0U);
    const Pairing pairing = pair_triangles(mesh, edge_bbsa, EdgeIdentity::Position);
    ASSERT_EQ(pairing.pair_count, 1U);
    EXPECT_EQ(pairing.pairs[0].vertices, (std::array<std::uint32_t, 4>{2, 0, 1, 5}));
}

TEST(Pairing, ManyTrianglesOnOneEdgeAreNotQuadratic) {
    constexpr std::uint32_t count = 300'000;
    TriangleMesh mesh;
    mesh.positions.resize(count + 2);
    for (std::uint32_t t = 0; t < count; ++t) mesh.triangles.push_back({0, 1, t + 2});
    for (const PairingMethod method : {window(max_pairing_window), edge_bbsa}) {
        EXPECT_EQ(pair_triangles(mesh, method, EdgeIdentity::Index).pair_count, count / 2);
    }
}

/// Sum over the pairs of what sa_exchange weighs them by, in units of half the area of a box.
double exchange_weight(const TriangleMesh& mesh, const Pairing& pairing) {
    double sum = 0;
    for (const TrianglePair& pair : pairing.pairs) {
        if (!pair.has_second) continue;
        const PairAreas areas = pair_areas({mesh.triangles, mesh.positions, {}}, {3 * pair.primitive_ids[0]},
                                           {3 * pair.primitive_ids[1]});
        sum += areas.saving() - 0.5 * areas.growth();
    }
    return sum;
}

TEST(SaExchange, TakesANeighbourFromAPairThatDoesNotPay) {
    // In a plane: 1 meets 0 on edge 0-1, whose box is the larger, and 2 on edge 0-2. 0 reaches far away.
    const TriangleMesh mesh{
        "", {{0, 0, 0}, {6, 6, 0}, {6, -5, 0}, {-30, 40, 0}, {0, -5, 0}}, {{0, 1, 3}, {1, 0, 2}, {0, 2, 4}}};
    // Half areas: 1440, 66 and 30; of 0 and 1 together 1620, of 1 and 2 together 66.
    EXPECT_EQ(partners_of(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Index), 3), (Partners{1, 0, {}}));
    EXPECT_EQ(partners_of(pair_triangles(mesh, sa_exchange, EdgeIdentity::Index), 3), (Partners{{}, 2, 1}));
}

TEST(SaExchange, FindsThePartnerThatIsLeftAnotherFreeNeighbour) {
    // A strip 3, 0, 1, 2 whose middle edge has the largest box: edge_bbsa pairs 0 and 1, leaves the ends.
    const TriangleMesh mesh{"",
                            {{0, 0, 0}, {7, 7, 0}, {6, -6, 0}, {-6, 6, 0}, {0, -6, 0}, {-6, 0, 0}},
                            {{0, 1, 3}, {1, 0, 2}, {0, 2, 4}, {3, 0, 5}}};
    EXPECT_EQ(partners_of(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Index), 4), (Partners{1, 0, {}, {}}));
    EXPECT_EQ(partners_of(pair_triangles(mesh, sa_exchange, EdgeIdentity::Index), 4), (Partners{3, 2, 1, 0}));
}

TEST(SaExchange, NeverWeighsLessThanEdgeBbsa) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = jittered_sheet(20, seed);
        const Pairing greedy = pair_triangles(mesh, edge_bbsa, EdgeIdentity::Position);
        const Pairing exchanged = pair_triangles(mesh, sa_exchange, EdgeIdentity::Position);
        EXPECT_GT(exchange_weight(mesh, exchanged), exchange_weight(mesh, greedy));
    }
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
    for (const char* name : {"none", "window:2", "window:65536", "edge_bbsa", "sa_exchange", "sa_saving"}) {
        EXPECT_EQ(to_string(parse_pairing_method(name)), name);
    }
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
