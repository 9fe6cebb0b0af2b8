#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "exact_reference.hpp"
#include "meshes.hpp"
#include "model/bvh.hpp"
#include "model/bvh_split.hpp"

namespace rtu::model {
namespace {

using test::image_of;
using test::needles;
using test::Random;
using test::Rational;
using Corner = std::array<Rational, 3>;
using Polygon = std::vector<Corner>;

Corner exact(Vec3 v) { return {Rational(v.x), Rational(v.y), Rational(v.z)}; }

// The part of a convex polygon where side * (x[axis] - plane) >= 0.
Polygon clipped(const Polygon& polygon, std::size_t axis, const Rational& plane, int side) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const Rational from = side * (a[axis] - plane), to = side * (b[axis] - plane);
        if (from >= 0) result.push_back(a);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
            Corner c;
            for (std::size_t k = 0; k < 3; ++k) c[k] = a[k] + from / (from - to) * (b[k] - a[k]);
            result.push_back(c);
        }
    }
    return result;
}

bool has_area(const Polygon& polygon) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3;
            const auto d = [&](std::size_t corner, std::size_t axis) -> Rational {
                return polygon[corner][axis] - polygon[0][axis];
            };
            if (d(i - 1, k) * d(i, l) != d(i - 1, l) * d(i, k)) return true;
        }
    }
    return false;
}

// Whether anything is left of the polygon when all boxes from the `first` on are taken away: exactly.
bool is_left(Polygon polygon, const std::vector<Aabb>& boxes, std::size_t first = 0) {
    if (!has_area(polygon)) return false;
    if (first == boxes.size()) return true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Rational lo(boxes[first].lo[axis]), hi(boxes[first].hi[axis]);
        if (is_left(clipped(polygon, axis, lo, -1), boxes, first + 1)) return true;
        if (is_left(clipped(polygon, axis, hi, 1), boxes, first + 1)) return true;
        polygon = clipped(clipped(polygon, axis, lo, 1), axis, hi, -1);
    }
    return false;
}

// The boxes of each pair's leaves, by its address.
template <std::uint32_t Width>
void collect(const MemoryImage& image, NodeRef ref, std::map<std::uint64_t, std::vector<Aabb>>& boxes) {
    const auto& node = image.node<Width>(ref);
    for (std::uint32_t i = 0; i < node.child_count; ++i) {
        if (node.child[i].is_leaf()) {
            boxes[node.child[i].address()].push_back(node.box(i));
        } else {
            collect<Width>(image, node.child[i], boxes);
        }
    }
}

std::map<std::uint64_t, std::vector<Aabb>> leaf_boxes(const MemoryImage& image) {
    std::map<std::uint64_t, std::vector<Aabb>> boxes;
    if (image.width == 2) collect<2>(image, image.root(), boxes);
    if (image.width == 4) collect<4>(image, image.root(), boxes);
    if (image.width == 6) collect<6>(image, image.root(), boxes);
    if (image.width == 8) collect<8>(image, image.root(), boxes);
    return boxes;
}

BvhOptions spatial(std::uint32_t width, std::uint32_t percent = 100) {
    return {.width = width, .splits = SplitKind::Spatial, .split_budget_percent = percent};
}

class SpatialSplits : public testing::TestWithParam<std::uint32_t> {};

TEST_P(SpatialSplits, CoverEveryTriangleExactly) {
    for (const TriangleMesh& mesh :
         {needles(60, 1, {0, 0, 0}), needles(40, 2, {1000, -70'000, 3}), test::triangle_soup(60, 3),
          test::closed_sphere(6, {0, 0, 0}, 1), test::triangle_soup(1, 4), needles(2, 5, {0, 0, 0})}) {
        const MemoryImage image = image_of(mesh, spatial(GetParam()));
        ASSERT_NO_THROW(validate(image, mesh));
        EXPECT_LE(image.reference_count, 2 * image.pair_count + 1);
        if (mesh.name == "needles" && mesh.triangles.size() > 2) {
            EXPECT_GT(image.reference_count, image.pair_count * 11 / 10);
        }
        const auto boxes = leaf_boxes(image);
        EXPECT_EQ(boxes.size(), image.pair_count);
        for (const auto& [address, of_pair] : boxes) {
            const auto& [v, ids, flags, reserved] = image.leaf_pair(NodeRef::leaf(address, 1), 0);
            EXPECT_FALSE(is_left({exact(v[0]), exact(v[1]), exact(v[2])}, of_pair)) << ids[0];
            if ((flags & 1U) == 0) continue;
            EXPECT_FALSE(is_left({exact(v[0]), exact(v[2]), exact(v[3])}, of_pair)) << ids[1];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllWidths, SpatialSplits, testing::Values(2U, 4U, 6U, 8U));

// Against the exact polygon: nothing of it is lost, and next to nothing is added.
TEST(PartBox, HoldsTheClippedPairAndLittleElse) {
    Random random(6);
    int parts = 0;
    for (int i = 0; i < 3'000; ++i) {
        const float scale = std::ldexp(1.0F, int(random.below(60)) - 30);
        const Vec3 offset = i % 3 == 0 ? random.point(-100, 100) : Vec3{};
        std::vector<Vec3> v;
        for (int k = 0; k < 4; ++k) v.push_back((offset + random.point(-1, 1)) * scale);
        if (i % 5 == 0) v[1] = v[0] + (v[1] - v[0]) * 1e-4F;
        const TrianglePair pair{.vertices = {0, 1, 2, 3}, .has_second = i % 2 == 0};
        Aabb box;
        for (const std::size_t k : {0U, 1U, 2U, i % 2 == 0 ? 3U : 2U}) box.extend(v[k]);
        const std::size_t axis = random.below(3);
        const float plane = box.lo[axis] + (box.hi[axis] - box.lo[axis]) * random.uniform(0, 1);
        const bool is_left_side = i % 7 < 4;
        const Aabb part = part_box(pair, v, box, axis, is_left_side ? box.lo[axis] : plane,
                                   is_left_side ? plane : box.hi[axis]);
        ASSERT_TRUE(box.contains(part));
        std::array<Rational, 3> lo, hi;
        bool is_first = true;
        for (const Polygon& whole : {Polygon{exact(v[0]), exact(v[1]), exact(v[2])},
                                     Polygon{exact(v[0]), exact(v[2]), exact(v[3])}}) {
            if (!pair.has_second && !is_first) break;
            for (const Corner& c : clipped(whole, axis, Rational(plane), is_left_side ? -1 : 1)) {
                for (std::size_t k = 0; k < 3; ++k) {
                    if (is_first || c[k] < lo[k]) lo[k] = c[k];
                    if (is_first || c[k] > hi[k]) hi[k] = c[k];
                }
                is_first = false;
            }
        }
        ASSERT_FALSE(is_first);
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_LE(Rational(part.lo[k]), lo[k]) << i;
            ASSERT_GE(Rational(part.hi[k]), hi[k]) << i;
            const Rational slack =
                Rational(0x1p-21) * Rational(std::max(std::abs(box.lo[k]), std::abs(box.hi[k])));
            ASSERT_GE(Rational(part.lo[k]) + slack, lo[k]) << i;
            ASSERT_LE(Rational(part.hi[k]) - slack, hi[k]) << i;
        }
        ++parts;
    }
    EXPECT_EQ(parts, 3'000);
}

TEST(PartBox, IsEmptyWhereThePairIsNot) {
    const std::vector<Vec3> v{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const TrianglePair lone{.vertices = {0, 1, 2, 2}};
    // The corner of the box that the triangle does not reach, left of x = 1 and beyond y = 1/2.
    const Aabb corner{{0.75F, 0.5F, 0}, {1, 1, 0}};
    EXPECT_EQ(part_box(lone, v, corner, 0, 0.75F, 1), Aabb{});
    EXPECT_EQ(tightened_box(lone, v, corner), corner);
    const Aabb lower{{0, 0, 0}, {1, 0.25F, 0}};
    EXPECT_EQ(part_box(lone, v, lower, 0, 0.875F, 1).hi.y, 0.125F + 0x1p-23F);
}

TEST(SpatialTree, IsByteIdenticalWhenBuiltTwice) {
    const TriangleMesh mesh = needles(3'000, 7, {0, 0, 0});
    const MemoryImage a = image_of(mesh, spatial(4)), b = image_of(mesh, spatial(4));
    ASSERT_EQ(a.size_bytes(), b.size_bytes());
    EXPECT_EQ(std::memcmp(a.blocks.data(), b.blocks.data(), a.size_bytes()), 0);
    EXPECT_GT(a.reference_count, 3'500U);
}

TEST(SpatialTree, StoresAPairOnceHoweverManyLeavesReferToIt) {
    const TriangleMesh mesh = needles(200, 8, {0, 0, 0});
    const MemoryImage image = image_of(mesh, spatial(4));
    EXPECT_EQ(image.size_bytes(), image.node_count * 128 + image.pair_count * image_block_bytes);
    EXPECT_EQ(image.leaf_count, image.reference_count);
    EXPECT_TRUE(image.has_shared_pairs());
    EXPECT_FALSE(image_of(mesh).has_shared_pairs());
}

TEST(SpatialTree, KeepsToItsBudget) {
    const TriangleMesh mesh = needles(1'000, 9, {0, 0, 0});
    for (const std::uint32_t percent : {1U, 10U, 50U}) {
        const MemoryImage image = image_of(mesh, spatial(4, percent));
        EXPECT_LE(image.reference_count, image.pair_count + image.pair_count * percent / 100 + 1);
        EXPECT_GT(image.reference_count, image.pair_count);
    }
}

TEST(SpatialTree, RefusesSeveralPairsALeaf) {
    BvhOptions options = spatial(4);
    options.max_leaf_pairs = 2;
    EXPECT_THROW((void)image_of(needles(3, 1, {0, 0, 0}), options), std::logic_error);
}

// One leaf's box made a hundredth smaller, or taken away, in every leaf of a shared pair.
TEST(SpatialValidation, SeesALeafThatDoesNotCoverItsPart) {
    const TriangleMesh mesh = needles(30, 10, {0, 0, 0});
    const MemoryImage good = image_of(mesh, spatial(4));
    ASSERT_NO_THROW(validate(good, mesh));
    auto counts = leaf_boxes(good);
    int damaged = 0;
    for (std::uint64_t n = 0; n < good.node_count; ++n) {
        const auto& node = good.node<4>(NodeRef::inner(n * 128));
        for (std::uint32_t i = 0; i < node.child_count; ++i) {
            if (!node.child[i].is_leaf() || counts[node.child[i].address()].size() < 2) continue;
            MemoryImage bad = good;
            auto& changed = *reinterpret_cast<Node<4>*>(&bad.blocks[n * 2]);
            changed.child[i] = node.child[(i + 1) % node.child_count];
            EXPECT_THROW(validate(bad, mesh), std::logic_error) << n << " " << i;
            ++damaged;
        }
    }
    EXPECT_GT(damaged, 10);
    MemoryImage bad = good;
    --bad.reference_count;
    EXPECT_THROW(validate(bad, mesh), std::logic_error);
}

}  // namespace
}  // namespace rtu::model
