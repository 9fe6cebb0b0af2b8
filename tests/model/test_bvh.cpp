#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "meshes.hpp"
#include "model/bvh.hpp"
#include "model/error.hpp"
#include "model/traversal.hpp"

namespace rtu::model {
namespace {

using test::image_of;

BvhOptions morton(std::uint32_t width, std::uint32_t max_leaf_pairs) {
    return {.width = width, .max_leaf_pairs = max_leaf_pairs, .builder = BvhBuilder::Morton};
}

class Shape : public testing::TestWithParam<BvhOptions> {};

TEST_P(Shape, IsValidOnEveryKindOfMesh) {
    for (const TriangleMesh& mesh :
         {test::triangle_soup(500, 1), test::closed_sphere(10, {0, 0, 0}, 1),
          test::closed_box(5, {0, 0, 0}, {1, 2, 3}), test::triangle_soup(1, 2), test::triangle_soup(2, 3)}) {
        const MemoryImage image = image_of(mesh, GetParam());
        EXPECT_NO_THROW(validate(image, mesh));
        EXPECT_EQ(image.size_bytes(),
                  image.node_count * image.node_bytes() + image.pair_count * image_block_bytes);
        EXPECT_LE(image.leaf_count, image.pair_count);
        EXPECT_GE(image.leaf_count * GetParam().max_leaf_pairs, image.pair_count);
    }
}

TEST_P(Shape, SurvivesManyTrianglesInOnePlace) {
    TriangleMesh mesh = test::triangle_soup(1, 4);
    mesh.triangles.assign(3'000, mesh.triangles[0]);
    EXPECT_NO_THROW(validate(image_of(mesh, GetParam()), mesh));
}

INSTANTIATE_TEST_SUITE_P(AllWidths, Shape,
                         testing::Values(BvhOptions{2, 1}, BvhOptions{4, 1}, BvhOptions{6, 1},
                                         BvhOptions{8, 1}, BvhOptions{4, 3}, BvhOptions{8, 8}, morton(2, 1),
                                         morton(4, 1), morton(6, 1), morton(8, 1), morton(4, 3),
                                         morton(8, 8)));

TEST(Bvh, IsByteIdenticalWhenBuiltTwice) {
    const TriangleMesh mesh = test::triangle_soup(20'000, 5, 0.1F);
    for (const BvhOptions& options : {BvhOptions{}, morton(4, 1)}) {
        const MemoryImage a = image_of(mesh, options), b = image_of(mesh, options);
        ASSERT_EQ(a.size_bytes(), b.size_bytes());
        EXPECT_EQ(std::memcmp(a.blocks.data(), b.blocks.data(), a.size_bytes()), 0);
    }
}

// Its boxes have more surface, which is what it does not look at; what is hit is the same.
TEST(Bvh, OfMortonCodesTakesMoreBoxTestsForTheSameHits) {
    // Triangles of every size: where a large one goes is what the heuristic is for.
    TriangleMesh mesh = test::triangle_soup(3'000, 9, 0.01F);
    const TriangleMesh large = test::triangle_soup(60, 11, 1.0F);
    for (const Triangle& t : large.triangles) {
        const auto begin = std::uint32_t(mesh.positions.size());
        for (const std::uint32_t corner : t) mesh.positions.push_back(large.positions[corner]);
        mesh.triangles.push_back({begin, begin + 1, begin + 2});
    }
    const MemoryImage sah = image_of(mesh), morton_image = image_of(mesh, morton(4, 1));
    EXPECT_EQ(morton_image.leaf_count, morton_image.pair_count);
    TraversalCounts by_sah, by_morton;
    test::Random random(10);
    for (int i = 0; i < 300; ++i) {
        const Vec3 from = random.point(-1, 2), to = random.point(0, 1);
        const Ray ray{from, 0, to - from, std::numeric_limits<float>::infinity()};
        ASSERT_EQ(trace(sah, ray, RayKind::ClosestHit, &by_sah),
                  trace(morton_image, ray, RayKind::ClosestHit, &by_morton));
    }
    EXPECT_GT(by_morton.box_tests, by_sah.box_tests * 11 / 10);
}

TEST(Bvh, OfMortonCodesHasNoSpatialSplits) {
    BvhOptions options = morton(4, 1);
    options.splits = SplitKind::Spatial;
    EXPECT_THROW((void)image_of(test::triangle_soup(3, 1), options), std::logic_error);
}

TEST(Bvh, HasOnePairALeafByDefault) {
    const MemoryImage image = image_of(test::triangle_soup(300, 6));
    EXPECT_EQ(image.leaf_count, image.pair_count);
    EXPECT_EQ(image.width, 4U);
}

TEST(Bvh, RefusesAnEmptyPairing) {
    EXPECT_THROW((void)build_bvh(TriangleMesh{"empty", {}, {}}, Pairing{}, {}), Error);
}

// Validation must see any damage: change one float or reference at a time.
TEST(BvhValidation, SeesEveryDamagedNode) {
    const TriangleMesh mesh = test::triangle_soup(40, 7);
    const MemoryImage good = image_of(mesh);
    for (std::uint64_t n = 0; n < good.node_count; ++n) {
        for (std::size_t word = 0; word < 29; ++word) {
            const auto& node = good.node<4>(NodeRef::inner(n * 128));
            const bool is_used = word == 28 || word % 4 < node.child_count;
            if (!is_used) continue;
            MemoryImage bad = good;
            auto* bytes = reinterpret_cast<unsigned char*>(&bad.blocks[n * 2]) + word * 4;
            bytes[0] = static_cast<unsigned char>(bytes[0] ^ 1U);
            EXPECT_THROW(validate(bad, mesh), std::logic_error) << "node " << n << " word " << word;
        }
    }
}

TEST(BvhValidation, SeesEveryDamagedLeafWord) {
    const TriangleMesh mesh = test::closed_sphere(4, {0, 0, 0}, 1);
    const MemoryImage good = image_of(mesh);
    const std::uint64_t first = good.node_count * 2;
    for (std::uint64_t leaf = 0; leaf < good.pair_count; ++leaf) {
        for (std::size_t word = 0; word < 14; ++word) {
            MemoryImage bad = good;
            auto* bytes = reinterpret_cast<unsigned char*>(&bad.blocks[first + leaf]) + word * 4;
            bytes[0] = static_cast<unsigned char>(bytes[0] ^ 1U);
            const bool is_shadowed = !good.leaf_pair(NodeRef::leaf((first + leaf) * 64, 1), 0).has_second() &&
                                     (word == 13 || word >= 9);
            if (is_shadowed) continue;
            EXPECT_THROW(validate(bad, mesh), std::logic_error) << "leaf " << leaf << " word " << word;
        }
    }
}

}  // namespace
}  // namespace rtu::model
