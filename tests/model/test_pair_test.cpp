#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "exact_reference.hpp"
#include "meshes.hpp"
#include "model/pair_test.hpp"
#include "model/ray_setup.hpp"
#include "model/vec3.hpp"

namespace rtu::model {
namespace {

using test::Random;

LeafPair lone(const TriangleMesh& mesh, std::uint32_t id) {
    const Triangle& t = mesh.triangles[id];
    return make_leaf_pair({.vertices = {t[0], t[1], t[2], t[2]}, .primitive_ids = {id, id}}, mesh.positions);
}

RaySetup setup(Vec3 origin, Vec3 direction, const Aabb& box) {
    return make_ray_setup({origin, 0, direction, infinity}, box);
}

// How many triangles of the mesh the ray pierces in front of its origin: tested one by one, no BVH.
int count_hits(const std::vector<LeafPair>& leaves, const RaySetup& ray) {
    int hits = 0;
    for (const LeafPair& leaf : leaves) {
        const PairHits found = test_pair(leaf, ray);
        hits += found.is_pierced[0] && found.hits[0].t > 0 ? 1 : 0;
    }
    return hits;
}

std::vector<LeafPair> all_lone(const TriangleMesh& mesh) {
    std::vector<LeafPair> leaves;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) leaves.push_back(lone(mesh, i));
    return leaves;
}

const TriangleMesh one_triangle{"one", {{0, 0, 5}, {4, 0, 5}, {0, 4, 5}}, {{0, 1, 2}}};

TEST(PairTest, ReportsDistanceAndBarycentricsOfTheFilesCorners) {
    const RaySetup ray = setup({1, 2, 1}, {0, 0, 2}, bounds(one_triangle));
    const PairHits found = test_pair(lone(one_triangle, 0), ray);
    ASSERT_TRUE(found.is_pierced[0]);
    EXPECT_FALSE(found.is_pierced[1]);
    EXPECT_EQ(found.hits[0], (Hit{2.0F, 0.25F, 0.5F, 0}));
}

TEST(PairTest, CountsBothSides) {
    const RaySetup ray = setup({1, 2, 9}, {0, 0, -1}, bounds(one_triangle));
    EXPECT_TRUE(test_pair(lone(one_triangle, 0), ray).is_pierced[0]);
}

// The stored corner order must not show in u and v.
TEST(PairTest, MapsBarycentricsBackThroughEveryCornerOrder) {
    const RaySetup ray = setup({1, 0.5F, 1}, {0.1F, 0.05F, 2}, bounds(one_triangle));
    const Hit expected = test_pair(lone(one_triangle, 0), ray).hits[0];
    for (std::uint8_t rotation = 0; rotation < 3; ++rotation) {
        for (const bool is_reversed : {false, true}) {
            TrianglePair pair{.primitive_ids = {0, 0},
                              .corner_order = {CornerOrder{rotation, is_reversed}, {}}};
            for (std::uint32_t k = 0; k < 3; ++k) {
                pair.vertices[(rotation + (is_reversed ? 3 - k : k)) % 3] = one_triangle.triangles[0][k];
            }
            pair.vertices[3] = pair.vertices[2];
            const PairHits found = test_pair(make_leaf_pair(pair, one_triangle.positions), ray);
            ASSERT_TRUE(found.is_pierced[0]);
            EXPECT_EQ(found.hits[0].u, expected.u);
            EXPECT_EQ(found.hits[0].v, expected.v);
        }
    }
}

// The four corners of a pair stored so that its triangles have these orders in the file.
LeafPair stored_pair(const TriangleMesh& mesh, std::array<CornerOrder, 2> orders) {
    return make_leaf_pair(
        {.vertices = {0, 1, 2, 3}, .primitive_ids = {0, 1}, .corner_order = orders, .has_second = true},
        mesh.positions);
}

// The same triangle on its own, in the file's order.
LeafPair stored_alone(const TriangleMesh& mesh, std::uint32_t id, CornerOrder order) {
    const Triangle& stored = mesh.triangles[id];
    const Triangle t{stored[order.stored_corner(0)], stored[order.stored_corner(1)],
                     stored[order.stored_corner(2)]};
    return make_leaf_pair({.vertices = {t[0], t[1], t[2], t[2]}, .primitive_ids = {id, id}}, mesh.positions);
}

TEST(PairTest, IsBitForBitTwoSingleTests) {
    Random random(1);
    std::uint32_t hits = 0;
    for (int i = 0; i < 200'000; ++i) {
        TriangleMesh mesh{"quad", {}, {{0, 1, 2}, {0, 2, 3}}};
        for (int k = 0; k < 4; ++k) mesh.positions.push_back(random.point(-1, 1));
        const auto order = [&] { return CornerOrder{std::uint8_t(random.below(3)), random.below(2) == 0}; };
        const std::array<CornerOrder, 2> orders{order(), order()};
        // Aim at the pair, at its common edge or at a common vertex, from afar or from all but the surface.
        const Vec3 a = mesh.positions[0], c = mesh.positions[2];
        const Vec3 target = i % 3 == 0   ? a
                            : i % 3 == 1 ? a + (c - a) * random.uniform(0, 1)
                                         : random.point(-1, 1);
        const Vec3 origin = i % 2 == 0 ? random.point(-3, 3)
                                       : (a + mesh.positions[1] + c) * (1.0F / 3) +
                                             random.point(-1, 1) * std::ldexp(1.0F, -int(random.below(60)));
        const RaySetup ray = setup(origin, target - origin, bounds(mesh));
        const PairHits both = test_pair(stored_pair(mesh, orders), ray);
        for (std::uint32_t id = 0; id < 2; ++id) {
            const PairHits single = test_pair(stored_alone(mesh, id, orders[id]), ray);
            ASSERT_EQ(both.is_pierced[id], single.is_pierced[0]);
            if (!single.is_pierced[0]) continue;
            ++hits;
            const Hit &x = both.hits[id], &y = single.hits[0];
            ASSERT_EQ(std::bit_cast<std::uint32_t>(x.t), std::bit_cast<std::uint32_t>(y.t));
            ASSERT_EQ(std::bit_cast<std::uint32_t>(x.u), std::bit_cast<std::uint32_t>(y.u));
            ASSERT_EQ(std::bit_cast<std::uint32_t>(x.v), std::bit_cast<std::uint32_t>(y.v));
        }
    }
    EXPECT_GT(hits, 50'000U);
}

TEST(PairTest, PiercesAFoldedPairTwice) {
    const TriangleMesh mesh{"folded", {{-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, -1, 2}}, {}};
    const LeafPair pair = make_leaf_pair(
        {.vertices = {0, 1, 2, 3}, .primitive_ids = {0, 1}, .corner_order = {}, .has_second = true},
        mesh.positions);
    const PairHits found = test_pair(pair, setup({-0.5F, -0.5F, 0}, {0, 0, 1}, bounds(mesh)));
    EXPECT_TRUE(found.is_pierced[0]);
    EXPECT_TRUE(found.is_pierced[1]);
    EXPECT_LT(found.hits[0].t, found.hits[1].t);
}

// A ray from inside a closed convex mesh leaves it exactly once, wherever it is aimed.
class ClosedMesh : public testing::TestWithParam<float> {};

TEST_P(ClosedMesh, IsLeftExactlyOnceThroughEveryVertexAndEdge) {
    const float offset = GetParam();
    const Vec3 centre{offset, -offset, 0.5F * offset};
    const TriangleMesh mesh = test::closed_sphere(12, centre, 2.0F);
    const auto leaves = all_lone(mesh);
    const Aabb box = bounds(mesh);
    Random random(7);
    for (int i = 0; i < 4'000; ++i) {
        const Triangle& t = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
        const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]];
        const Vec3 target = i % 2 == 0 ? a : a + (b - a) * random.uniform(0, 1);
        const Vec3 origin = centre + random.point(-0.5F, 0.5F);
        ASSERT_EQ(count_hits(leaves, setup(origin, target - origin, box)), 1) << "ray " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(AtOffsets, ClosedMesh, testing::Values(0.0F, 1e3F, 1e4F, 148376.0F, 1e5F));

TEST(PairTest, AxisAlignedRaysLeaveAGridBoxExactlyOnce) {
    const TriangleMesh mesh = test::closed_box(8, {-1, -1, -1}, {1, 1, 1});
    const auto leaves = all_lone(mesh);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            for (const float zero : {0.0F, -0.0F}) {
                for (int i = 1; i < 16; ++i) {
                    for (int j = 1; j < 16; ++j) {
                        Vec3 origin{}, direction{zero, zero, zero};
                        origin[(axis + 1) % 3] = float(i) / 8 - 1;
                        origin[(axis + 2) % 3] = float(j) / 8 - 1;
                        direction[axis] = sign;
                        ASSERT_EQ(count_hits(leaves, setup(origin, direction, bounds(mesh))), 1);
                    }
                }
            }
        }
    }
}

// How a ray's parts are drawn for the comparison with rational arithmetic.
struct PlacedTriangle {
    const char* name;
    float offset;    // of everything from the coordinate system's origin
    float width;     // of the triangle across its longest side
    float distance;  // of the ray's origin, in sizes of the triangle
    bool is_aimed_at_edge;
};

class AgainstRationalArithmetic : public testing::TestWithParam<PlacedTriangle> {};

std::ostream& operator<<(std::ostream& out, const PlacedTriangle& c) { return out << c.name; }

TEST_P(AgainstRationalArithmetic, DecidesAndMeasuresTheSame) {
    const auto [name, offset, width, distance, is_aimed_at_edge] = GetParam();
    Random random(5);
    int hits = 0, exact_tests = 0;
    constexpr int rays = 10'000;
    for (int i = 0; i < rays; ++i) {
        const Vec3 centre{offset, 0.3F * offset, -offset};
        const Vec3 a = centre + random.point(-1, 1), b = centre + random.point(-1, 1);
        const Vec3 c = a + (b - a) * random.uniform(0, 1) + random.point(-1, 1) * width;
        const TriangleMesh mesh{"one", {a, b, c}, {{0, 1, 2}}};
        const Vec3 origin =
            (distance < 1 ? (a + b + c) * (1.0F / 3) : centre) + random.point(-1, 1) * distance;
        const Vec3 target = is_aimed_at_edge ? a + (b - a) * (i % 4 == 0 ? 0.0F : random.uniform(0, 1))
                                             : centre + random.point(-1, 1);
        const RaySetup ray = setup(origin, target - origin, bounds(mesh));
        const PairHits found = test_pair(lone(mesh, 0), ray);
        auto expected =
            test::exact_hit({ray.origin, ray.direction, ray.kz}, {a, b, c}, ray.kz, ray.direction[ray.kz]);
        if (expected && expected->t <= 0) expected.reset();
        ASSERT_EQ(found.is_pierced[0], expected.has_value()) << "ray " << i;
        exact_tests += int(found.exact_tests);
        if (!expected) continue;
        ++hits;
        EXPECT_EQ(found.hits[0].t, test::rounded_once(expected->t));
        EXPECT_EQ(found.hits[0].u, test::rounded_once(expected->u));
        EXPECT_EQ(found.hits[0].v, test::rounded_once(expected->v));
    }
    EXPECT_GE(hits, rays / 50);
    EXPECT_LE(hits, distance > 1 ? rays - rays / 4 : rays);
    // The first pass must be worth its while where rays do not aim at edges.
    if (!is_aimed_at_edge && distance > 1) {
        EXPECT_LE(exact_tests, hits + rays / 1000);
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, AgainstRationalArithmetic,
                         testing::Values(PlacedTriangle{"Anywhere", 0, 1, 3, false},
                                         PlacedTriangle{"AtTheEdge", 0, 1, 3, true},
                                         PlacedTriangle{"FarAway", 1e6F, 1, 3, true},
                                         PlacedTriangle{"Needles", 0, 1e-4F, 3, true},
                                         PlacedTriangle{"FarNeedles", 1e4F, 1e-3F, 3, true},
                                         PlacedTriangle{"FromADistance", 0, 1, 0x1p20F, true},
                                         PlacedTriangle{"OffTheSurface", 0, 1, 0x1p-30F, false},
                                         PlacedTriangle{"OffNeedles", 4, 0x1p-12F, 0x1p-24F, false}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(PairTest, NeverHitsADegenerateTriangle) {
    Random random(3);
    for (int i = 0; i < 10'000; ++i) {
        TriangleMesh mesh{"line", {}, {{0, 1, 2}}};
        const auto grid = [&] { return float(int(random.below(64)) - 32); };
        const Vec3 a{grid(), grid(), grid()}, step{grid(), grid(), grid()};
        mesh.positions = {a, a + step * 2.0F, a + step * float(random.below(4))};
        const Vec3 origin = random.point(-90, 90);
        const Vec3 target =
            mesh.positions[0] + (mesh.positions[1] - mesh.positions[0]) * random.uniform(0, 1);
        const RaySetup ray = setup(origin, target - origin, bounds(mesh));
        ASSERT_FALSE(test_pair(lone(mesh, 0), ray).is_pierced[0]);
    }
}

TEST(RaySetup, RefusesRaysThatCannotHit) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(can_hit({{nan, 0, 0}, 0, {0, 0, 1}, 1}));
    EXPECT_FALSE(can_hit({{0, 0, 0}, 0, {0, nan, 1}, 1}));
    EXPECT_FALSE(can_hit({{0, 0, 0}, 0, {0, infinity, 1}, 1}));
    EXPECT_FALSE(can_hit({{0, 0, 0}, 0, {0, 0, 0}, 1}));
    EXPECT_FALSE(can_hit({{0, 0, 0}, 1, {0, 0, 1}, 1}));
    EXPECT_FALSE(can_hit({{0, 0, 0}, nan, {0, 0, 1}, 1}));
    EXPECT_TRUE(can_hit({{0, 0, 0}, 0, {0, 0, 1e-40F}, infinity}));
}

}  // namespace
}  // namespace rtu::model
