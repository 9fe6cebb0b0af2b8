#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes.hpp"
#include "model/gltf.hpp"
#include "model/quantised_node.hpp"
#include "model/slab_test.hpp"
#include "model/traversal.hpp"
#include "model/vec3.hpp"
#include "tests/scenes.hpp"

namespace rtu::model {
namespace {

using test::image_of;
using test::Random;

constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = std::numeric_limits<float>::denorm_min();

// A coordinate of any size, also subnormal, either zero, or next to overflow.
float any_coordinate(Random& random, std::uint32_t kind) {
    const float x = random.uniform(-1, 1);
    switch (kind) {
        case 0:
            return x;
        case 1:
            return x * largest;
        case 2:
            return x * 0x1p-126F;
        case 3:
            return std::ldexp(x, int(random.below(250)) - 140);
        case 4:
            return 1e6F + x;
        case 5:
            return float(int(random.below(3)) - 1) * 0.0F;
        default:
            return float(int(random.below(3)) - 1) * (random.below(2) == 0 ? largest : smallest);
    }
}

template <std::uint32_t Width>
Node<Width> any_node(Random& random) {
    Node<Width> node{};
    node.child_count = 1 + random.below(Width);
    for (std::uint32_t i = 0; i < Width; ++i) {
        Aabb box;
        for (int corner = 0; corner < 2 && i < node.child_count; ++corner) {
            Vec3 p;
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = any_coordinate(random, random.below(7));
            box.extend(p);
        }
        if (i < node.child_count && random.below(3) == 0) {  // a flat one
            const std::size_t axis = random.below(3);
            box.hi[axis] = box.lo[axis];
        }
        node.set_box(i, box);
        node.child[i] = i < node.child_count ? NodeRef::inner(64 * (i + 1)) : NodeRef();
    }
    return node;
}

template <std::uint32_t Width>
void expect_smallest_enclosing_boxes(std::uint32_t count) {
    Random random(Width);
    for (std::uint32_t n = 0; n < count; ++n) {
        const Node<Width> node = any_node<Width>(random);
        const QuantisedNode<Width> quantised = quantise(node);
        ASSERT_EQ(quantised.child_count, node.child_count);
        for (std::uint32_t i = 0; i < node.child_count; ++i) {
            const Aabb exact = node.box(i), box = quantised.box(i);
            ASSERT_TRUE(box.contains(exact)) << "node " << n << " child " << i;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::uint32_t lo = quantised.planes[0][axis][i], hi = quantised.planes[1][axis][i];
                ASSERT_TRUE(lo == 255 || quantised.plane(axis, lo + 1) > exact.lo[axis]);
                ASSERT_TRUE(hi == 0 || quantised.plane(axis, hi - 1) < exact.hi[axis]);
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {  // half the step would not reach
            if (quantised.exponent[axis] == 1) continue;
            Aabb whole;
            for (std::uint32_t i = 0; i < node.child_count; ++i) whole.extend(node.box(i));
            QuantisedNode<Width> finer = quantised;
            --finer.exponent[axis];
            ASSERT_LT(finer.plane(axis, 255), whole.hi[axis]) << "node " << n;
        }
    }
}

TEST(QuantisedNode, HasTheSmallestEnclosingBoxesOfItsFinestGrid) {
    expect_smallest_enclosing_boxes<2>(5'000);
    expect_smallest_enclosing_boxes<4>(5'000);
    expect_smallest_enclosing_boxes<6>(5'000);
    expect_smallest_enclosing_boxes<8>(5'000);
}

TEST(QuantisedNode, HasTheBytesThatItsHeaderSays) {
    Node<4> node{};
    node.child_count = 3;
    node.child = {NodeRef::inner(0x140), NodeRef::leaf(0x1000, 3), NodeRef::inner(0x180), NodeRef()};
    node.set_box(0, {{0, -1, 8}, {255, 1, 8}});
    node.set_box(1, {{10.5F, 0, 8}, {20.5F, 0, 8}});
    node.set_box(2, {{1, 0.25F, 8}, {2, 0.5F, 8}});
    node.set_box(3, Aabb{});
    const QuantisedNode<4> quantised = quantise(node);
    EXPECT_EQ(quantised.origin, (std::array<float, 3>{0, -1, 8}));
    EXPECT_EQ(quantised.exponent, (std::array<std::uint8_t, 3>{127, 121, 1}));  // steps of 1, 2^-6, 2^-126
    using Row = std::array<std::uint8_t, 4>;
    EXPECT_EQ(quantised.planes[0][0], (Row{0, 10, 1, 255}));
    EXPECT_EQ(quantised.planes[1][0], (Row{255, 21, 2, 0}));
    EXPECT_EQ(quantised.planes[0][1], (Row{0, 64, 80, 255}));
    EXPECT_EQ(quantised.planes[1][2], (Row{0, 0, 0, 0}));
    EXPECT_EQ(quantised.first_node, 0x140U / 64);
    EXPECT_EQ(quantised.first_leaf, 0x1000U / 64);
    EXPECT_EQ(quantised.kinds, (std::array<std::uint8_t, 2>{0xa0, 0x00}));
    EXPECT_EQ(quantised.child(1), NodeRef::leaf(0x1000, 3));
    EXPECT_EQ(quantised.child(2), NodeRef::inner(0x180));
}

// The steps to a hit stay on the safe side bit for bit, whatever overflows on the way.
TEST(QuantisedNode, IsEnteredWhereverAndNoLaterThanItsExactNode) {
    Random random(7);
    std::uint64_t entered = 0, extra = 0;
    for (int n = 0; n < 60'000; ++n) {
        const Node<8> node = any_node<8>(random);
        Aabb whole;
        for (std::uint32_t i = 0; i < node.child_count; ++i) whole.extend(node.box(i));
        Ray ray{{}, 0, {}, infinity};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = any_coordinate(random, random.below(7));
            ray.direction[axis] = any_coordinate(random, random.below(7));
        }
        if (n % 2 == 0) {  // towards a box
            const Aabb target = node.box(random.below(node.child_count));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                ray.direction[axis] = target.lo[axis] / 2 + target.hi[axis] / 2 - ray.origin[axis];
            }
        }
        if (!can_hit(ray)) continue;
        const SlabRay<4> slab_ray(make_ray_setup(ray, whole));
        const float t_end = n % 3 == 0 ? random.uniform(0, 2) : infinity;
        const auto exact = slab_test(node, slab_ray, t_end);
        const auto quantised = slab_test(quantise(node), slab_ray, t_end);
        ASSERT_EQ(exact.mask & ~quantised.mask, 0U) << "node " << n;
        for (std::uint32_t i = 0; i < 8; ++i) {
            if ((exact.mask >> i & 1) != 0) {
                ASSERT_LE(quantised.t_near[i], exact.t_near[i]) << "node " << n;
            }
        }
        entered += std::uint64_t(std::popcount(exact.mask));
        extra += std::uint64_t(std::popcount(quantised.mask & ~exact.mask));
    }
    EXPECT_GT(entered, 20'000U);
    EXPECT_GT(extra, 1'000U);
}

class QuantisedShape : public testing::TestWithParam<BvhOptions> {
  protected:
    [[nodiscard]] static MemoryImage full(const TriangleMesh& mesh) { return image_of(mesh, GetParam()); }
    [[nodiscard]] static MemoryImage quantised(const TriangleMesh& mesh) {
        BvhOptions options = GetParam();
        options.node_format = NodeFormat::Quantised;
        return image_of(mesh, options);
    }
};

// The mesh, each coordinate times `scale` plus `offset`.
TriangleMesh moved(TriangleMesh mesh, float scale, float offset) {
    for (Vec3& p : mesh.positions) p = p * scale + Vec3{offset, offset, offset};
    return mesh;
}

std::vector<TriangleMesh> meshes() {
    const TriangleMesh soup = test::triangle_soup(200, 11, 0.2F);
    TriangleMesh flat = soup;
    for (Vec3& p : flat.positions) p.y = -0.0F;
    std::vector<TriangleMesh> all{soup,
                                  flat,
                                  test::closed_sphere(8, {0.5F, 0.5F, 0.5F}, 0.4F),
                                  test::triangle_soup(1, 2),
                                  moved(soup, 1, 1e6F),
                                  moved(soup, 1e19F, 0),
                                  moved(soup, 1e-30F, 0),
                                  moved(soup, 0x1p-140F, 0)};
    return all;
}

TEST_P(QuantisedShape, IsValidAndHoldsTheSameTree) {
    for (const TriangleMesh& mesh : meshes()) {
        const MemoryImage a = full(mesh), b = quantised(mesh);
        EXPECT_NO_THROW(validate(b, mesh));
        EXPECT_EQ(b.node_count, a.node_count);
        EXPECT_EQ(b.leaf_count, a.leaf_count);
        EXPECT_EQ(b.depth, a.depth);
        EXPECT_EQ(b.node_bytes(), GetParam().width == 8 ? 128U : 64U);
        EXPECT_EQ(b.size_bytes(), b.node_count * b.node_bytes() + b.pair_count * image_block_bytes);
    }
}

TEST_P(QuantisedShape, FindsTheHitsOfTheFullNodesBitForBit) {
    int hits = 0;
    for (const TriangleMesh& mesh : meshes()) {
        const MemoryImage a = full(mesh), b = quantised(mesh);
        Random random(3);
        const Vec3 size = a.bounds.hi - a.bounds.lo;
        for (int i = 0; i < 1'000; ++i) {
            Ray ray{{}, 0, {}, i % 4 == 0 ? 0.8F : infinity};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                ray.origin[axis] = a.bounds.lo[axis] + size[axis] * random.uniform(-1, 2);
                ray.direction[axis] =
                    a.bounds.lo[axis] + size[axis] * random.uniform(0, 1) - ray.origin[axis];
            }
            if (i % 7 == 0) ray.direction[std::size_t(i) % 3] = i % 2 == 0 ? 0.0F : -0.0F;
            const auto expected = trace(a, ray, RayKind::ClosestHit);
            ASSERT_EQ(trace(b, ray, RayKind::ClosestHit), expected) << "ray " << i;
            ASSERT_EQ(trace(b, ray, RayKind::AnyHit).has_value(), expected.has_value()) << "ray " << i;
            hits += expected ? 1 : 0;
        }
    }
    EXPECT_GT(hits, 500);
}

// The nodes of both trees that stand for each other, by following both.
template <std::uint32_t Width>
void match(const MemoryImage& a, NodeRef in_a, const MemoryImage& b, NodeRef in_b,
           std::vector<NodeRef>& full_of) {
    full_of[in_b.address() / b.node_bytes()] = in_a;
    const auto& node = b.node_as<QuantisedNode<Width>>(in_b);
    std::uint64_t next_node = 0, next_leaf = 0;
    for (std::uint32_t i = 0; i < node.child_count; ++i) {
        const NodeRef child = node.child(i);
        ASSERT_EQ(child.is_leaf(), a.node<Width>(in_a).child[i].is_leaf());
        std::uint64_t& next = child.is_leaf() ? next_leaf : next_node;
        if (next != 0) {
            ASSERT_EQ(child.address(), next) << "children do not lie side by side";
        }
        next = child.address() + (child.is_leaf() ? child.pair_count() * 64ULL : b.node_bytes());
        if (!child.is_leaf()) match<Width>(a, a.node<Width>(in_a).child[i], b, child, full_of);
    }
}

template <std::uint32_t Width>
void expect_extra_hits_as_counted(const MemoryImage& a, const MemoryImage& b) {
    std::vector<NodeRef> full_of(b.node_count);
    match<Width>(a, a.root(), b, b.root(), full_of);
    Random random(4);
    Traversal traversal;
    std::uint64_t hits = 0, extra = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3 from = random.point(-1, 2);
        const Ray ray{from, 0, random.point(0, 1) - from, infinity};
        if (!start(traversal, b, ray, RayKind::ClosestHit)) continue;
        do {
            const NodeRef ref = traversal.current.ref;
            if (ref.is_leaf()) {
                for (std::uint32_t k = 0; k < ref.pair_count(); ++k) visit_pair(traversal, b, k);
                continue;
            }
            const auto& full_node = a.node<Width>(full_of[ref.address() / b.node_bytes()]);
            const SlabRay<slab_lanes<Width>> slab_ray(traversal.ray);
            const auto exact = slab_test(full_node, slab_ray, traversal.closest.hit.t);
            const NodeVisit visit = visit_node(traversal, b);
            ASSERT_EQ(visit.box_tests, full_node.child_count);
            ASSERT_EQ(visit.box_hits - visit.extra_hits, std::uint32_t(std::popcount(exact.mask)));
            hits += visit.box_hits;
            extra += visit.extra_hits;
        } while (pop(traversal));
    }
    EXPECT_GT(hits, 1'000U);
    EXPECT_GT(extra, 0U);
    EXPECT_LT(extra, hits / 5);
}

TEST_P(QuantisedShape, CountsTheBoxesEnteredBecauseOfQuantisationOnly) {
    const TriangleMesh mesh = test::triangle_soup(400, 12, 0.1F);
    const MemoryImage a = full(mesh), b = quantised(mesh);
    switch (GetParam().width) {
        case 2:
            return expect_extra_hits_as_counted<2>(a, b);
        case 4:
            return expect_extra_hits_as_counted<4>(a, b);
        case 6:
            return expect_extra_hits_as_counted<6>(a, b);
        default:
            return expect_extra_hits_as_counted<8>(a, b);
    }
}

INSTANTIATE_TEST_SUITE_P(AllWidths, QuantisedShape,
                         testing::Values(BvhOptions{2, 1}, BvhOptions{4, 1}, BvhOptions{6, 1},
                                         BvhOptions{8, 1}, BvhOptions{6, 3}, BvhOptions{8, 8}));

TEST(QuantisedNode, ValidationSeesEveryDamagedByte) {
    const TriangleMesh mesh = test::triangle_soup(60, 7);
    const MemoryImage good = image_of(mesh, {6, 2, NodeFormat::Quantised});
    constexpr std::size_t used_bytes = 63;
    for (std::uint64_t n = 0; n < good.node_count; ++n) {
        for (std::size_t byte = 0; byte < used_bytes; ++byte) {
            MemoryImage bad = good;
            bad.blocks[n].bytes[byte] ^= std::byte{1};
            EXPECT_THROW(validate(bad, mesh), std::logic_error) << "node " << n << " byte " << byte;
        }
    }
}

TEST(QuantisedNode, FindsTheHitsOfFullNodesInRealScenes) {
    int scenes = 0;
    for (const char* name : {"bunny.glb", "sponza.glb", "conference.glb"}) {
        const auto file = test::scene_file(name);
        if (!file) continue;
        ++scenes;
        const TriangleMesh mesh = load_gltf(*file);
        const Pairing pairing = pair_triangles(mesh, {PairingKind::EdgeBbsa, 0}, EdgeIdentity::Position);
        const MemoryImage a = build_bvh(mesh, pairing, {6, 1});
        const MemoryImage b = quantise_nodes(a);
        Random random(5);
        for (int i = 0; i < 5'000; ++i) {
            const auto inside = [&] {
                return Vec3{random.uniform(a.bounds.lo.x, a.bounds.hi.x),
                            random.uniform(a.bounds.lo.y, a.bounds.hi.y),
                            random.uniform(a.bounds.lo.z, a.bounds.hi.z)};
            };
            const Vec3 from = inside();
            const Ray ray{from, 0, inside() - from, infinity};
            ASSERT_EQ(trace(b, ray, RayKind::ClosestHit), trace(a, ray, RayKind::ClosestHit)) << name;
        }
    }
    if (scenes == 0) GTEST_SKIP() << "no scenes: see RTUSIM_SCENES";
}

}  // namespace
}  // namespace rtu::model
