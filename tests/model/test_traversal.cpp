#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes.hpp"
#include "model/pair_test.hpp"
#include "model/slab_test.hpp"
#include "model/traversal.hpp"
#include "model/vec3.hpp"

namespace rtu::model {
namespace {

using test::image_of;
using test::Random;

Ray ray_between(Vec3 from, Vec3 to, float t_max = infinity) { return {from, 0, to - from, t_max}; }

// Every pair against the ray, nearest hit, lowest primitive id: no tree, no boxes that could cull.
std::optional<Hit> brute_force(const MemoryImage& image, const Ray& ray) {
    const RaySetup setup = make_ray_setup(ray, image.bounds);
    std::optional<Hit> best;
    const std::uint64_t first = image.node_count * image.node_bytes();
    for (std::uint64_t i = 0; i < image.pair_count; ++i) {
        const LeafPair& pair = image.leaf_pair(NodeRef::leaf(first + i * image_block_bytes, 1), 0);
        const PairHits found = test_pair(pair, setup);
        for (std::size_t k = 0; k < 2; ++k) {
            const Hit& hit = found.hits[k];
            if (!found.is_pierced[k] || !(hit.t > ray.t_min && hit.t < ray.t_max)) continue;
            if (!best || hit.t < best->t || (hit.t == best->t && hit.primitive_id < best->primitive_id))
                best = hit;
        }
    }
    return best;
}

class Width : public testing::TestWithParam<BvhOptions> {};

TEST_P(Width, FindsWhatBruteForceFinds) {
    int hits = 0;
    for (const TriangleMesh& mesh :
         {test::triangle_soup(300, 1, 0.2F), test::closed_sphere(8, {0.5F, 0.5F, 0.5F}, 0.4F),
          test::closed_box(4, {0, 0, 0}, {1, 1, 1})}) {
        const MemoryImage image = image_of(mesh, GetParam());
        Random random(2);
        for (int i = 0; i < 3'000; ++i) {
            Ray ray = ray_between(random.point(-1, 2), random.point(0, 1), i % 4 == 0 ? 0.8F : infinity);
            if (i % 5 == 0) ray.t_min = 0.5F;
            if (i % 7 == 0) ray.direction[std::size_t(i) % 3] = 0;
            const auto expected = brute_force(image, ray);
            ASSERT_EQ(trace(image, ray, RayKind::ClosestHit), expected) << "ray " << i;
            ASSERT_EQ(trace(image, ray, RayKind::AnyHit).has_value(), expected.has_value()) << "ray " << i;
            hits += expected ? 1 : 0;
        }
    }
    EXPECT_GT(hits, 3'000);
}

INSTANTIATE_TEST_SUITE_P(All, Width,
                         testing::Values(BvhOptions{2, 1}, BvhOptions{4, 1}, BvhOptions{6, 1},
                                         BvhOptions{8, 1}, BvhOptions{4, 4}));

// Long thin triangles, far offsets, rays near the plane's edges: where a slab test without a bound on the
// shear's rounding would cull boxes of accepted hits.
TEST(Traversal, LosesNoAcceptedHitToABox) {
    for (const float offset : {0.0F, 1e3F, 1e5F}) {
        Random random(9);
        for (int i = 0; i < 20'000; ++i) {
            const Vec3 centre{offset, offset, -offset};
            const float z = random.uniform(0.001F, 0.01F);
            TriangleMesh mesh{
                "sliver",
                {centre + Vec3{-1000, 1, z}, centre + Vec3{1000, 1, z},
                 centre + Vec3{random.uniform(-1000, 1000), 1, z + random.uniform(1e-4F, 1000.0F)}},
                {{0, 1, 2}}};
            const MemoryImage image = image_of(mesh, {}, {PairingKind::None, 0});
            const Vec3 target =
                mesh.positions[0] + (mesh.positions[1] - mesh.positions[0]) * random.uniform(0, 1);
            const Vec3 origin = centre + random.point(-0.5F, 0.5F);
            const Ray ray = ray_between(origin, target);
            ASSERT_EQ(trace(image, ray, RayKind::ClosestHit), brute_force(image, ray)) << "ray " << i;
        }
    }
}

// The smallest scene is the triangle itself, where the slab test has the least room for its rounding.
TEST(SlabTest, NeverEntersABoxBehindAnAcceptedHit) {
    Random random(10);
    int hits = 0;
    for (int i = 0; i < 400'000; ++i) {
        const float offset = std::ldexp(1.0F, int(random.below(20)));
        TriangleMesh mesh{"one", {}, {{0, 1, 2}}};
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(Vec3{offset, 1, 0} + random.point(-1, 1));
        if (i % 2 == 0) {
            for (Vec3& p : mesh.positions)
                p[std::size_t(i / 2) % 3] = mesh.positions[0][std::size_t(i / 2) % 3];
        }
        const Vec3 target = (mesh.positions[0] + mesh.positions[1]) * 0.4F + mesh.positions[2] * 0.2F;
        const Vec3 origin = target + random.point(-1, 1) * (i % 3 == 0 ? 1.0F : 100.0F);
        const Ray ray = ray_between(origin, target);
        const RaySetup setup = make_ray_setup(ray, bounds(mesh));
        const auto pair = make_leaf_pair({.vertices = {0, 1, 2, 2}, .primitive_ids = {0, 0}}, mesh.positions);
        const PairHits found = test_pair(pair, setup);
        if (!found.is_pierced[0] || !(found.hits[0].t > 0)) continue;
        ++hits;
        Node<4> node{};
        node.child_count = 1;
        node.set_box(0, bounds(mesh));
        const auto slab = slab_test(node, SlabRay<4>(setup), found.hits[0].t);
        ASSERT_EQ(slab.mask, 1U) << "ray " << i;
        ASSERT_LE(slab.t_near[0], found.hits[0].t) << "ray " << i;
    }
    EXPECT_GT(hits, 200'000);
}

// A ray that starts on a surface does not hit it, and one that starts above it does, however little.
TEST(Traversal, TellsOnASurfaceFromAboveIt) {
    Random random(12);
    for (const float height : {0.0F, 1.0F, -0.3F, 100.1F}) {
        const TriangleMesh floor{"floor",
                                 {{-10, height, -10}, {10, height, -10}, {10, height, 10}, {-10, height, 10}},
                                 {{0, 1, 2}, {0, 2, 3}}};
        const MemoryImage image = image_of(floor);
        for (int i = 0; i < 20'000; ++i) {
            const Vec3 up{random.uniform(-1, 1), random.uniform(0.01F, 1), random.uniform(-1, 1)};
            const Vec3 on{random.uniform(-9, 9), height, random.uniform(-9, 9)};
            ASSERT_FALSE(trace(image, {on, 0, up, infinity}, RayKind::ClosestHit)) << "ray " << i;
        }
    }
    const MemoryImage image = image_of(test::closed_box(1, {0, 0, 0}, {1, 1, 1}));
    for (int i = 0; i < 50'000; ++i) {
        const float above = std::ldexp(1.0F, -int(random.below(140)) - 1);
        const Vec3 down{random.uniform(-1, 1), random.uniform(-1, -0.01F), random.uniform(-1, 1)};
        const Vec3 origin{random.uniform(0.1F, 0.9F), above, random.uniform(0.1F, 0.9F)};
        ASSERT_TRUE(trace(image, {origin, 0, down, infinity}, RayKind::ClosestHit)) << "ray " << i;
    }
}

// Coplanar triangles at one distance: the lowest id, whether they share a leaf or not.
TEST(Traversal, DoesNotDependOnTheTree) {
    Random random(13);
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
        TriangleMesh mesh{"coplanar", {}, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
        const auto grid = [&] { return float(int(random.below(17)) - 8); };
        for (int k = 0; k < 9; ++k) mesh.positions.push_back({0, grid(), grid()});
        const Vec3 origin{std::ldexp(1.0F, -int(random.below(60))), grid() / 2, grid() / 2};
        const Ray ray{
            origin, 0, {random.uniform(-1, -0.01F), random.uniform(-1, 1), random.uniform(-1, 1)}, infinity};
        const PairingMethod none{PairingKind::None, 0};
        const auto hit = trace(image_of(mesh, {4, 1}, none), ray, RayKind::ClosestHit);
        ASSERT_EQ(trace(image_of(mesh, {4, 8}, none), ray, RayKind::ClosestHit), hit) << "ray " << i;
        ASSERT_EQ(trace(image_of(mesh, {2, 1}), ray, RayKind::ClosestHit), hit) << "ray " << i;
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(hits, 2'000);
}

// A mesh so thin that the rounding of the slab test's padding would underflow.
TEST(Traversal, FindsTrianglesOfSubnormalWidth) {
    const TriangleMesh sliver{"sliver",
                              {{-0x1.dcp-143F, -0x1.6p-143F, -0x1.0224bp-3F},
                               {-0x1.cp-147F, 0x1.b8p-143F, -0x1.e5ce4p-4F},
                               {0x1.4cp-143F, -0x1.6p-143F, 0x1.3ae53cp-1F}},
                              {{0, 1, 2}}};
    const Ray ray{
        {0x1.68p-144F, -0x1.98p-143F, -1}, 0, {-0x1.48p-60F, 0x1.cp-64F, 0x1.bf76d4p+81F}, infinity};
    EXPECT_EQ(trace(image_of(sliver), ray, RayKind::ClosestHit), brute_force(image_of(sliver), ray));
    EXPECT_TRUE(trace(image_of(sliver), ray, RayKind::ClosestHit));
}

TEST(Traversal, NeverLeaksThroughAClosedMesh) {
    for (const float offset : {0.0F, 1e3F, 148376.0F}) {
        const Vec3 centre{offset, -offset, offset};
        const TriangleMesh mesh = test::closed_sphere(40, centre, 2);
        const MemoryImage image = image_of(mesh);
        Random random(4);
        for (int i = 0; i < 30'000; ++i) {
            const Triangle& t = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
            const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]];
            const Vec3 target = i % 2 == 0 ? a : a + (b - a) * random.uniform(0, 1);
            const Ray ray = ray_between(centre + random.point(-0.5F, 0.5F), target);
            ASSERT_TRUE(trace(image, ray, RayKind::ClosestHit)) << "offset " << offset << " ray " << i;
        }
    }
}

TEST(Traversal, GivesEqualDistancesToTheLowestPrimitive) {
    TriangleMesh mesh = test::triangle_soup(1, 8);
    mesh.triangles.assign(64, mesh.triangles[0]);
    const auto& p = mesh.positions;
    const Vec3 middle = (p[0] + p[1] + p[2]) * (1.0F / 3.0F);
    for (const std::uint32_t width : {2U, 4U, 6U, 8U}) {
        const auto hit =
            trace(image_of(mesh, {width, 1}), ray_between({5, 6, 7}, middle), RayKind::ClosestHit);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->primitive_id, 0U);
    }
}

TEST(Traversal, CountsWhatItDoes) {
    const TriangleMesh mesh = test::triangle_soup(1, 8);
    const MemoryImage image = image_of(mesh);
    TraversalCounts counts;
    (void)trace(image, ray_between({5, 6, 7}, image.bounds.lo), RayKind::ClosestHit, &counts);
    EXPECT_EQ(counts.node_visits, 1U);
    EXPECT_EQ(counts.box_tests, 1U);
    EXPECT_EQ(counts.pair_tests, counts.triangle_tests);
}

TEST(Traversal, MissesWithRaysThatCannotHit) {
    const MemoryImage image = image_of(test::triangle_soup(20, 8));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    TraversalCounts counts;
    EXPECT_FALSE(trace(image, {{nan, 0, 0}, 0, {0, 0, 1}, 1}, RayKind::ClosestHit, &counts));
    EXPECT_FALSE(trace(image, {{0, 0, 0}, 0, {0, 0, 0}, 1}, RayKind::AnyHit, &counts));
    EXPECT_FALSE(trace(image, {{0, 0, 0}, 2, {0, 0, 1}, 1}, RayKind::ClosestHit, &counts));
    EXPECT_EQ(counts, TraversalCounts{});
}

TEST(Traversal, NeverNeedsMoreStackThanItSays) {
    const TriangleMesh mesh = test::triangle_soup(3'000, 12, 0.3F);
    for (const std::uint32_t width : {2U, 4U, 6U, 8U}) {
        const MemoryImage image = image_of(mesh, {width, 1});
        Traversal traversal;
        std::size_t deepest = 0;
        Random random(5);
        for (int i = 0; i < 300; ++i) {
            bool is_running = start(traversal, image, ray_between(random.point(-1, 2), random.point(0, 1)),
                                    RayKind::ClosestHit);
            while (is_running) {
                if (traversal.current.ref.is_leaf()) {
                    visit_pair(traversal, image, 0);
                } else {
                    visit_node(traversal, image);
                }
                deepest = std::max(deepest, traversal.stack.size());
                is_running = pop(traversal);
            }
        }
        EXPECT_LE(deepest, stack_capacity(image));
        EXPECT_GT(deepest, width);
    }
}

}  // namespace
}  // namespace rtu::model
