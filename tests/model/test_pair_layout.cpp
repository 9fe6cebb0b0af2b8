#include <gtest/gtest.h>

#include <set>

#include "model/pair_layout.hpp"
#include "model/pairing.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

Triangle rotated(const Triangle& t, std::uint32_t by) {
    return {t[by % 3], t[(by + 1) % 3], t[(by + 2) % 3]};
}

std::set<std::uint32_t> as_set(std::uint32_t a, std::uint32_t b) { return {a, b}; }

/// Two triangles on the edge 0-2, their first corners at every place and the second of either winding.
template <class Check>
void for_each_placement(const Triangle& first, const Triangle& second, Check check) {
    for (std::uint32_t r0 = 0; r0 < 3; ++r0) {
        for (std::uint32_t r1 = 0; r1 < 3; ++r1) {
            for (const bool is_flipped : {false, true}) {
                SCOPED_TRACE(testing::Message() << r0 << r1 << is_flipped);
                const Triangle flipped{second[1], second[0], second[2]};
                check(rotated(first, r0), rotated(is_flipped ? flipped : second, r1), is_flipped);
            }
        }
    }
}

TrianglePair pair_of(const TriangleMesh& mesh, EdgeIdentity identity) {
    const Pairing pairing = pair_triangles(mesh, {}, identity);
    EXPECT_EQ(pairing.pair_count, 1U);
    return pairing.pairs.at(0);
}

TEST(PairLayout, RestoresFileCornersForEveryPlacementOfTheCommonEdge) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for_each_placement({0, 1, 2}, {0, 2, 3}, [&](const Triangle& t0, const Triangle& t1, bool is_flipped) {
        const TrianglePair pair = pair_of({"", positions, {t0, t1}}, EdgeIdentity::Index);
        EXPECT_EQ(pair.vertices, (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
        EXPECT_EQ(file_corners(pair, 0), t0);
        EXPECT_EQ(file_corners(pair, 1), t1);
        EXPECT_FALSE(pair.corner_order[0].is_reversed) << "triangle 0 keeps its winding";
        EXPECT_EQ(pair.corner_order[1].is_reversed, is_flipped);
    });
}

TEST(PairLayout, RestoresAFoldedPair) {
    // The second apex lies on the same side of the common edge as the first.
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 1}};
    for_each_placement({0, 1, 2}, {0, 2, 3}, [&](const Triangle& t0, const Triangle& t1, bool) {
        const TrianglePair pair = pair_of({"", positions, {t0, t1}}, EdgeIdentity::Index);
        EXPECT_EQ(file_corners(pair, 0), t0);
        EXPECT_EQ(file_corners(pair, 1), t1);
    });
}

TEST(PairLayout, RestoresTheSameTriangleTwice) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 2, 0}, {3, 1, 5}};
    for_each_placement({0, 1, 2}, {0, 2, 1}, [&](const Triangle& t0, const Triangle& t1, bool) {
        const TrianglePair pair = pair_of({"", positions, {t0, t1}}, EdgeIdentity::Index);
        EXPECT_EQ(file_corners(pair, 0), t0);
        EXPECT_EQ(file_corners(pair, 1), t1);
        EXPECT_EQ(pair.vertices[1], pair.vertices[3]);
    });
}

TEST(PairLayout, RestoresDegenerateTriangles) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 2, 0}, {3, 1, 5}};
    for (const Triangle& thin : {Triangle{0, 2, 2}, Triangle{0, 2, 0}}) {
        for_each_placement({0, 1, 2}, thin, [&](const Triangle& t0, const Triangle& t1, bool) {
            for (const std::vector<Triangle>& triangles : {std::vector{t0, t1}, std::vector{t1, t0}}) {
                const TrianglePair pair = pair_of({"", positions, triangles}, EdgeIdentity::Index);
                EXPECT_EQ(file_corners(pair, 0), triangles[0]);
                EXPECT_EQ(file_corners(pair, 1), triangles[1]);
                EXPECT_EQ(as_set(pair.vertices[0], pair.vertices[2]), as_set(0, 2));
            }
        });
    }
}

TEST(PairLayout, RestoresSplitVerticesByPosition) {
    // Vertices 4 and 5 lie where 0 and 2 do.
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 0}};
    for_each_placement({0, 1, 2}, {4, 5, 3}, [&](const Triangle& t0, const Triangle& t1, bool) {
        const TrianglePair pair = pair_of({"", positions, {t0, t1}}, EdgeIdentity::Position);
        EXPECT_EQ(pair.vertices, (std::array<std::uint32_t, 4>{0, 1, 2, 3})) << "triangle 0's indices";
        EXPECT_EQ(file_corners(pair, 0), t0);
        for (std::uint32_t k = 0; k < 3; ++k) {
            EXPECT_EQ(positions[file_corners(pair, 1)[k]], positions[t1[k]]);
        }
    });
}

TEST(PairLayout, StoresALoneTriangleInFileOrder) {
    const std::vector<Triangle> triangles{{0, 0, 0}, {7, 5, 6}};
    const TrianglePair pair = make_lone({triangles, {}, {}}, 1);
    EXPECT_EQ(pair.vertices, (std::array<std::uint32_t, 4>{7, 5, 6, 6}));
    EXPECT_EQ(pair.primitive_ids, (std::array<std::uint32_t, 2>{1, 1}));
    EXPECT_FALSE(pair.has_second);
    EXPECT_EQ(file_corners(pair, 0), triangles[1]);
    EXPECT_EQ(file_corners(pair, 1), triangles[1]);
}

TEST(PairLayout, RefusesTrianglesWithoutACommonEdge) {
    const std::vector<Triangle> triangles{{0, 1, 2}, {1, 2, 3}};
    const std::vector<std::uint32_t> ids{0, 1, 2, 3};
    const IdentifiedMesh mesh{triangles, {}, ids};
    EXPECT_NO_THROW((void)make_pair(mesh, {1}, {3}));
    EXPECT_THROW((void)make_pair(mesh, {0}, {3}), std::logic_error);
    EXPECT_THROW((void)make_pair(mesh, {1}, {4}), std::logic_error);
    EXPECT_THROW((void)make_pair(mesh, {1}, {1}), std::logic_error);
}

}  // namespace
}  // namespace rtu::test
