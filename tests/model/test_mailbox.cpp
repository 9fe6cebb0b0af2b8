#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <set>

#include "meshes.hpp"
#include "model/all_hits.hpp"
#include "model/pair_test.hpp"
#include "model/traversal.hpp"
#include "model/vec3.hpp"

namespace rtu::model {
namespace {

using test::image_of;
using test::Random;

constexpr BvhOptions with_splits{.width = 4, .splits = SplitKind::Spatial, .split_budget_percent = 200};

NodeRef leaf_of(std::uint32_t pair) { return NodeRef::leaf(std::uint64_t(pair) * image_block_bytes, 1); }

// The mailbox as a person would write it: the list of the last k numbers, in order.
class OrderedList {
  public:
    explicit OrderedList(std::size_t entries) : entries_(entries) {}
    MailboxAnswer look_up(std::uint32_t pair) {
        if (std::ranges::find(last_, pair) != last_.end()) return MailboxAnswer::Known;
        last_.push_back(pair);
        if (last_.size() > entries_) last_.pop_front();
        return all_.insert(pair).second ? MailboxAnswer::New : MailboxAnswer::Again;
    }

  private:
    std::size_t entries_;
    std::deque<std::uint32_t> last_;
    std::set<std::uint32_t> all_;
};

TEST(Mailbox, OfRecentPairsIsTheOrderedListOfTheLastOnes) {
    for (std::uint32_t entries = 0; entries <= max_mailbox_entries; ++entries) {
        Random random(entries);
        Mailbox mailbox({MailboxKind::Recent, entries});
        for (int ray = 0; ray < 50; ++ray) {
            mailbox.clear(true);
            OrderedList reference(entries);
            for (int i = 0; i < 100; ++i) {
                const std::uint32_t pair = random.below(3 + 2 * entries);
                ASSERT_EQ(mailbox.look_up(leaf_of(pair)), reference.look_up(pair))
                    << entries << " entries, ray " << ray << ", look-up " << i;
            }
        }
    }
}

TEST(Mailbox, OfHashedPairsHasOnePlaceForEach) {
    Mailbox mailbox({MailboxKind::Hashed, 4});
    mailbox.clear(true);
    using enum MailboxAnswer;
    EXPECT_EQ(mailbox.look_up(leaf_of(0)), New);
    EXPECT_EQ(mailbox.look_up(leaf_of(1)), New);
    EXPECT_EQ(mailbox.look_up(leaf_of(0)), Known);
    EXPECT_EQ(mailbox.look_up(leaf_of(4)), New);  // takes the place of 0
    EXPECT_EQ(mailbox.look_up(leaf_of(0)), Again);
    EXPECT_EQ(mailbox.look_up(leaf_of(1)), Known);
    mailbox.clear(true);
    EXPECT_EQ(mailbox.look_up(leaf_of(1)), New);
}

TEST(Mailbox, OfEveryPairForgetsNone) {
    Mailbox mailbox({MailboxKind::PerPair, 0});
    mailbox.clear(true);
    for (std::uint32_t pair = 0; pair < 100; ++pair)
        EXPECT_EQ(mailbox.look_up(leaf_of(pair)), MailboxAnswer::New);
    for (std::uint32_t pair = 0; pair < 100; ++pair) {
        EXPECT_EQ(mailbox.look_up(leaf_of(pair)), MailboxAnswer::Known);
    }
}

std::vector<MailboxOptions> all_mailboxes() {
    std::vector<MailboxOptions> all{{MailboxKind::PerPair, 0}};
    for (const std::uint32_t entries : {0U, 1U, 2U, 3U, 8U, 16U})
        all.push_back({MailboxKind::Recent, entries});
    for (const std::uint32_t entries : {1U, 8U}) all.push_back({MailboxKind::Hashed, entries});
    return all;
}

// Through the middle of one of the triangles, from anywhere about.
Ray random_ray(Random& random, const TriangleMesh& mesh, int i) {
    const Triangle& triangle = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
    Vec3 middle;
    for (const std::uint32_t corner : triangle) middle = middle + mesh.positions[corner] * (1.0F / 3);
    const Vec3 from = random.point(-1, 2);
    return {from, i % 5 == 0 ? 0.5F : 0.0F, middle - from, i % 4 == 0 ? 0.8F : infinity};
}

// Every pair against the ray, without a tree.
std::vector<Hit> all_hits_by_brute_force(const MemoryImage& image, const Ray& ray) {
    std::vector<Hit> hits;
    const RaySetup setup = make_ray_setup(ray, image.bounds);
    const std::uint64_t first = image.node_count * image.node_bytes();
    for (std::uint64_t i = 0; i < image.pair_count; ++i) {
        const PairHits found =
            test_pair(image.leaf_pair(NodeRef::leaf(first + i * image_block_bytes, 1), 0), setup);
        for (std::size_t k = 0; k < 2; ++k) {
            const Hit& hit = found.hits[k];
            if (found.is_pierced[k] && hit.t > ray.t_min && hit.t < ray.t_max) hits.push_back(hit);
        }
    }
    std::ranges::sort(hits, {}, [](const Hit& hit) { return std::pair(hit.t, hit.primitive_id); });
    return hits;
}

// The pairs that a ray comes to, in order, and what an OrderedList says of them.
TraversalCounts reference_counts(const MemoryImage& image, const Ray& ray, RayKind kind,
                                 std::size_t entries) {
    TraversalCounts counts;
    OrderedList list(entries);
    Traversal walk;
    for (bool goes_on = start(walk, image, ray, kind); goes_on; goes_on = !is_satisfied(walk) && pop(walk)) {
        const NodeRef ref = walk.current.ref;
        if (!ref.is_leaf()) {
            ++counts.node_visits;
            counts.box_tests += visit_node(walk, image).box_tests;
            continue;
        }
        const MailboxAnswer answer = list.look_up(std::uint32_t(ref.address() / image_block_bytes));
        if (answer == MailboxAnswer::Known) {
            ++counts.mailbox_hits;
            continue;
        }
        counts.duplicate_tests += answer == MailboxAnswer::Again ? 1 : 0;
        ++counts.pair_tests;
        counts.triangle_tests += visit_pair(walk, image, 0).triangle_tests;
    }
    return counts;
}

TEST(MailboxTraversal, ChangesNoHitWhateverTheSplits) {
    for (const std::uint32_t width : {2U, 4U, 8U}) {
        const TriangleMesh mesh = test::needles(400, width, {0.5F, 0.5F, 0.5F});
        const MemoryImage plain = image_of(mesh, {width, 1});
        const MemoryImage split =
            image_of(mesh, {.width = width, .splits = SplitKind::Spatial, .split_budget_percent = 200});
        ASSERT_GT(split.reference_count, split.pair_count * 11 / 10);
        Random random(width);
        TraversalStack stack;
        for (int i = 0; i < 300; ++i) {
            const Ray ray = random_ray(random, mesh, i);
            const std::vector<Hit> all = all_hits_by_brute_force(plain, ray);
            const auto closest = all.empty() ? std::nullopt : std::optional(all.front());
            ASSERT_EQ(trace(plain, ray, RayKind::ClosestHit), closest);
            for (const MailboxOptions& options : all_mailboxes()) {
                Mailbox mailbox(options);
                ASSERT_EQ(trace(stack, mailbox, split, ray, RayKind::ClosestHit), closest) << i;
                ASSERT_EQ(trace(stack, mailbox, plain, ray, RayKind::ClosestHit), closest) << i;
                ASSERT_EQ(trace(stack, mailbox, split, ray, RayKind::AnyHit),
                          trace(split, ray, RayKind::AnyHit));
                ASSERT_EQ(trace(split, ray, RayKind::AnyHit).has_value(), closest.has_value());
            }
        }
    }
}

TEST(MailboxTraversal, CountsAsTheOrderedListDoes) {
    const TriangleMesh mesh = test::needles(1'000, 5, {0.5F, 0.5F, 0.5F});
    const MemoryImage image = image_of(mesh, with_splits);
    TraversalStack stack;
    std::uint64_t hits = 0, duplicates = 0;
    for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
        for (const std::uint32_t entries : {0U, 1U, 2U, 5U, 16U}) {
            Mailbox mailbox({MailboxKind::Recent, entries});
            Random random(6);
            for (int i = 0; i < 300; ++i) {
                const Ray ray = random_ray(random, mesh, i);
                TraversalCounts counts;
                static_cast<void>(trace(stack, mailbox, image, ray, kind, &counts));
                ASSERT_EQ(counts, reference_counts(image, ray, kind, entries)) << entries << ", ray " << i;
                hits += counts.mailbox_hits;
                duplicates += counts.duplicate_tests;
            }
        }
    }
    EXPECT_GT(hits, 500U);
    EXPECT_GT(duplicates, 500U);
}

TEST(MailboxTraversal, SavesNothingWhereEveryPairIsInOneLeaf) {
    const TriangleMesh mesh = test::triangle_soup(300, 8, 0.5F);
    const MemoryImage image = image_of(mesh);
    Random random(9);
    TraversalStack stack;
    for (int i = 0; i < 200; ++i) {
        const Ray ray = random_ray(random, mesh, i);
        TraversalCounts without, with;
        Mailbox mailbox({MailboxKind::Recent, 8});
        static_cast<void>(trace(stack, image, ray, RayKind::ClosestHit, &without));
        static_cast<void>(trace(stack, mailbox, image, ray, RayKind::ClosestHit, &with));
        ASSERT_EQ(with, without);
        ASSERT_EQ(with.mailbox_hits + with.duplicate_tests, 0U);
    }
}

TEST(AllHitsOfARay, AreEachToldOnceWhereDuplicatesAreForbidden) {
    const TriangleMesh mesh = test::needles(600, 10, {0.5F, 0.5F, 0.5F});
    const MemoryImage split = image_of(mesh, with_splits), plain = image_of(mesh);
    Random random(11);
    std::uint64_t duplicates = 0;
    const auto sorted = [](std::vector<Hit> hits) {
        std::ranges::sort(hits, {}, [](const Hit& hit) { return std::pair(hit.t, hit.primitive_id); });
        return hits;
    };
    for (int i = 0; i < 300; ++i) {
        const Ray ray = random_ray(random, mesh, i);
        const std::vector<Hit> expected = all_hits_by_brute_force(plain, ray);
        for (const MailboxOptions& options : all_mailboxes()) {
            const AllHits once = find_all_hits(split, ray, options, DuplicateRule::Forbidden);
            ASSERT_EQ(sorted(once.hits), expected);
            ASSERT_EQ(once.duplicates, 0U);
            const AllHits told = find_all_hits(split, ray, options, DuplicateRule::Allowed);
            ASSERT_EQ(told.hits.size(), expected.size() + told.duplicates);
            if (options.kind == MailboxKind::PerPair) {
                ASSERT_EQ(told.duplicates, 0U);
            }
            if (!options.is_on()) duplicates += told.duplicates;
        }
        ASSERT_EQ(find_all_hits(plain, ray, {}, DuplicateRule::Allowed).duplicates, 0U);
    }
    EXPECT_GT(duplicates, 5U);
}

}  // namespace
}  // namespace rtu::model
