#include <gtest/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>

#include "model/edge_bbsa_compressed.hpp"
#include "model/matching.hpp"
#include "model/pairing.hpp"
#include "tests/model/pairing_checks.hpp"
#include "tests/model/pairing_meshes.hpp"
#include "tests/model/reference_pairing.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

constexpr PairingMethod edge_bbsa{PairingKind::EdgeBbsa, 0};
constexpr PairingMethod compressed{PairingKind::EdgeBbsaCompressed, 0};
constexpr PairingMethod sa_exchange{PairingKind::SaExchange, 0};
constexpr PairingMethod sa_saving{PairingKind::SaSaving, 0};
constexpr PairingMethod maximum{PairingKind::Maximum, 0};

double total_weight(const TriangleMesh& mesh, const Pairing& pairing) {
    double sum = 0;
    for (const TrianglePair& pair : pairing.pairs) {
        if (pair.has_second) sum += exchange_weight(mesh, pair.primitive_ids[0], pair.primitive_ids[1]);
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
        EXPECT_GT(total_weight(mesh, exchanged), total_weight(mesh, greedy));
    }
}

TEST(SaExchange, EqualsTheReference) {
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE(seed);
        for (const TriangleMesh& mesh : {chaotic_mesh(seed), jittered_sheet(8, seed)}) {
            for (const EdgeIdentity identity : identities) {
                EXPECT_EQ(partners_of(pair_triangles(mesh, sa_exchange, identity), mesh.triangles.size()),
                          reference_sa_exchange(mesh, identity));
            }
        }
    }
}

TEST(Matching, FreesBothTrianglesOfAPair) {
    ScratchMemory memory(1 << 12);
    Matching matching(4, memory);
    EXPECT_TRUE(matching.try_pair({3}, {7}));
    EXPECT_FALSE(matching.try_pair({4}, {9})) << "triangle 1 is taken";
    matching.unpair(2);
    EXPECT_EQ(matching.pair_count(), 0U);
    for (std::uint32_t t = 0; t < 4; ++t) {
        EXPECT_TRUE(matching.is_free(t));
        EXPECT_EQ(matching.partner(t).triangle(), t);
    }
}

TEST(SaSaving, EqualsTheReference) {
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        for (const TriangleMesh& mesh : {chaotic_mesh(seed), jittered_sheet(6, seed)}) {
            for (const EdgeIdentity identity : identities) {
                EXPECT_EQ(partners_of(pair_triangles(mesh, sa_saving, identity), mesh.triangles.size()),
                          reference_sa_saving(mesh, identity));
            }
        }
    }
}

/// Edmonds' algorithm on every two triangles with a common edge, from nothing.
std::uint64_t maximum_pair_count(const TriangleMesh& mesh, EdgeIdentity identity) {
    using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
    const std::vector<std::uint32_t> ids = identify(mesh, identity);
    Graph graph(mesh.triangles.size());
    for (std::uint32_t s = 0; s < mesh.triangles.size(); ++s) {
        for (std::uint32_t t = s + 1; t < mesh.triangles.size(); ++t) {
            if (share_edge(mesh.triangles[s], mesh.triangles[t], ids)) boost::add_edge(s, t, graph);
        }
    }
    std::vector<boost::graph_traits<Graph>::vertex_descriptor> mates(mesh.triangles.size());
    boost::edmonds_maximum_cardinality_matching(graph, mates.data());
    return boost::matching_size(graph, mates.data());
}

TEST(Maximum, HasAsManyPairsAsThereCanBe) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        for (const TriangleMesh& mesh : {chaotic_mesh(seed), jittered_sheet(7, seed)}) {
            for (const EdgeIdentity identity : identities) {
                EXPECT_EQ(pair_triangles(mesh, maximum, identity).pair_count,
                          maximum_pair_count(mesh, identity));
            }
        }
    }
}

TEST(Maximum, CrossesOddCycles) {
    // A fan of five triangles around vertex 0 is an odd cycle; 5 and 6 hang on the outside of 0 and 1.
    TriangleMesh mesh{"", std::vector<Vec3>(8), {}};
    for (std::uint32_t i = 0; i < 5; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 5});
    mesh.triangles.push_back({1, 2, 6});
    EXPECT_EQ(pair_triangles(mesh, maximum, EdgeIdentity::Index).pair_count, 3U);
    mesh.triangles.push_back({2, 3, 7});
    EXPECT_EQ(pair_triangles(mesh, maximum, EdgeIdentity::Index).pair_count, 3U);
}

TEST(CompressedEdge, KeepsTheOrderOfAreasAndIsSymmetric) {
    const Aabb scene{{0, 0, 0}, {8, 8, 8}};
    const auto key = [&](Vec3 a, Vec3 b) { return compress_edge(a, b, scene); };
    EXPECT_LT(key({0, 0, 0}, {2, 2, 2}), key({0, 0, 0}, {1, 1, 1})) << "larger areas come first";
    EXPECT_EQ(key({0, 1, 7}, {3, 3, 3}), key({3, 3, 3}, {0, 1, 7}));
    // Midpoint (4, 2, 1) of 8: 2^23, 2^22, 2^21 in the three fields; area 0: the largest rank.
    EXPECT_EQ(key({4, 2, 0}, {4, 2, 2}), (CompressedEdgeKey{0xffffff80, 0x00004000, 0x00200000}));
    // Area 12 is 0x41400000; without the low 7 bits 0x828000, and its complement in 24 bits 0x7d7fff.
    EXPECT_EQ(key({0, 0, 0}, {2, 2, 2})[0] >> 8, 0x7d7fffU);
    EXPECT_EQ(key({8, 8, 8}, {8, 8, 8})[2] & 0xffffffU, 0xffffffU) << "the box's end stays in the last step";
}

TEST(Compressed, LosesNothingWhereKeysAreDistinct) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = jittered_sheet(10, seed);
        const std::size_t count = mesh.triangles.size();
        EXPECT_EQ(partners_of(pair_triangles(mesh, compressed, EdgeIdentity::Position), count),
                  partners_of(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Position), count));
    }
}

CompressionCost cost_of(const TriangleMesh& mesh) {
    ScratchMemory memory(1 << 20);
    return compression_cost({mesh.triangles, mesh.positions, weld_positions(mesh.positions, memory)}, memory);
}

TEST(Compressed, CountsThePairsOfBothWays) {
    for (const TriangleMesh& mesh : {split_sheet(20, 1), chaotic_mesh(5), chaotic_mesh(17)}) {
        for (const EdgeIdentity identity : identities) {
            const CompressionCost cost = compression_cost(mesh, identity);
            EXPECT_EQ(cost.exact_pairs, pair_triangles(mesh, edge_bbsa, identity).pair_count);
            EXPECT_EQ(cost.pairs, pair_triangles(mesh, compressed, identity).pair_count);
            EXPECT_GE(cost.candidates - cost.wrong_candidates, cost.pairs);
        }
    }
    EXPECT_EQ(compression_cost(split_sheet(20, 1), EdgeIdentity::Position).exact_candidates,
              3U * 20 * 20 - 2 * 20);  // its inner edges
}

TEST(Compressed, FindsOutTheDiagonalsOfARectangle) {
    // Both diagonals of the rectangle have one midpoint and one area: equal keys, different edges.
    const TriangleMesh mesh{
        "", {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, {2, 1, 5}, {2, 1, -5}}, {{0, 2, 4}, {1, 3, 5}}};
    EXPECT_EQ(pair_triangles(mesh, compressed, EdgeIdentity::Position).pair_count, 0U);
    const CompressionCost cost = cost_of(mesh);
    EXPECT_EQ(cost.candidates, 1U);
    EXPECT_EQ(cost.wrong_candidates, 1U);
    EXPECT_EQ(cost.exact_candidates, 0U);
}

TEST(Compressed, CountsTheCandidatesThatAWrongOneHides) {
    // Two pairs on the two diagonals, in the file's order 0, 1, 0, 1: no twin is next to its own.
    const TriangleMesh mesh{
        "",
        {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, {2, 1, 5}, {2, 1, -5}, {2, 1, 9}, {2, 1, -9}},
        {{0, 2, 4}, {1, 3, 5}, {0, 2, 6}, {1, 3, 7}}};
    EXPECT_EQ(pair_triangles(mesh, edge_bbsa, EdgeIdentity::Position).pair_count, 2U);
    EXPECT_EQ(pair_triangles(mesh, compressed, EdgeIdentity::Position).pair_count, 0U);
    const CompressionCost cost = cost_of(mesh);
    EXPECT_EQ(cost.exact_candidates, 2U);
    EXPECT_EQ(cost.candidates, 3U);
    EXPECT_EQ(cost.wrong_candidates, 3U);
    EXPECT_EQ(cost.lost_candidates, 2U);
}

}  // namespace
}  // namespace rtu::test
