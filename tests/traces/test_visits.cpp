#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/traversal.hpp"
#include "tests/traces/trace_examples.hpp"
#include "traces/recorded_walk.hpp"
#include "traces/visit_check.hpp"

namespace rtu::test {
namespace {

using model::RayKind;
using traces::RayChunk;
using traces::VisitChunk;

std::vector<model::Ray> rays_into_cube(std::uint32_t count) {
    Random random(4);
    std::vector<model::Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 from = random.point(-1, 2);
        rays.push_back({from, 0, random.point(0, 1) - from, 1e30F});
    }
    rays[5].direction = {0, 0, 0};  // one that is not traversed
    return rays;
}

VisitChunk example(RayKind kind, const MemoryImage& image, std::uint32_t count) {
    return record_visits(RayChunk{"w", kind, traces::IdKind::None, 0, rays_into_cube(count), {}}, image)
        .front();
}

// Walks a recorded ray to its end.
model::TraversalCounts replay(const std::shared_ptr<const VisitChunk>& chunk, std::uint32_t index) {
    model::TraversalCounts counts;
    traces::RecordedWalk walk;
    for (bool goes_on = walk.start({chunk, index}); goes_on;) {
        if (walk.current().is_leaf()) {
            for (std::uint32_t i = 0; i < walk.current().pair_count() && !walk.is_satisfied(); ++i) {
                counts.triangle_tests += walk.visit_pair().triangle_tests;
                ++counts.pair_tests;
            }
        } else {
            counts.box_tests += walk.child_count();
            ++counts.node_visits;
            walk.visit_node();
        }
        // The upper half of the stack first, as if the rest lay in memory.
        goes_on = !walk.is_satisfied() && (walk.pop(walk.stack_size() / 2) || walk.pop(0));
    }
    return counts;
}

TEST(Visits, ReplayToTheCountsAndHitsOfTheTraversal) {
    for (const model::BvhOptions options :
         {model::BvhOptions{2, 1}, {4, 1}, {6, 2}, {8, 8}, {6, 2, model::NodeFormat::Quantised}}) {
        const auto image = image_of(triangle_soup(500, 3, 0.15F), options);
        for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
            const auto chunk = std::make_shared<const VisitChunk>(
                traces::decode_visit_chunk(encode(example(kind, image, 400)), traces::image_facts(image)));
            const auto rays = rays_into_cube(400);
            for (std::uint32_t i = 0; i < rays.size(); ++i) {
                model::TraversalCounts counts;
                EXPECT_EQ(chunk->rays[i].hit, model::trace(image, rays[i], kind, &counts)) << i;
                ASSERT_EQ(replay(chunk, i), counts) << "ray " << i;
            }
            EXPECT_EQ(chunk->rays[5].visit_count, 0U);
        }
    }
}

// Content that no traversal can have is refused although its checksum is right: a replay would go astray.
TEST(Visits, ImpossibleTraversalsAreRefused) {
    const auto image = image_of(triangle_soup(300, 5, 0.2F), {4, 2});
    const auto facts = traces::image_facts(image);
    const VisitChunk good = example(RayKind::ClosestHit, image, 50);
    std::size_t leaf = 0, inner = 0;
    for (std::size_t i = 1; i + 1 < good.visits.size(); ++i) {
        (good.visits[i].ref.is_leaf() ? leaf : inner) = i;
    }
    const auto fault = [&](auto change) {
        VisitChunk bad = good;
        change(bad);
        return error_of([&] { static_cast<void>(traces::decode_visit_chunk(encode(bad), facts)); });
    };
    using testing::HasSubstr;
    EXPECT_EQ(fault([](VisitChunk&) {}), "");
    EXPECT_THAT(fault([&](auto& c) { c.visits[leaf].ref = model::NodeRef::leaf(facts.size_bytes, 1); }),
                HasSubstr("leaf outside"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[leaf].ref = model::NodeRef::leaf(0, 1); }),
                HasSubstr("leaf outside"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[inner].ref = model::NodeRef::inner(64); }),
                HasSubstr("node outside"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[inner].ref = model::NodeRef::inner(facts.size_bytes); }),
                HasSubstr("node outside"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[0].ref = model::NodeRef::inner(128); }), HasSubstr("root"));
    EXPECT_THAT(fault([&](auto& c) { ++c.visits[inner].dropped_entries; }), HasSubstr("not pushed"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[inner].dropped_entries = ~0U; }), HasSubstr("not pushed"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[inner].pushes = 9; }), HasSubstr("count of boxes"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[inner].tests = 0; }), HasSubstr("count of boxes"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[inner].extra_hits = 1; }), HasSubstr("count of boxes"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[leaf].extra_hits = 1; }), HasSubstr("pushes after a leaf"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[leaf].tests = 0; }), HasSubstr("count of pair tests"));
    EXPECT_THAT(fault([&](auto& c) { c.visits[leaf].pushes = 1; }), HasSubstr("pushes after a leaf"));
    EXPECT_THAT(fault([&](auto& c) { c.pair_tests[0].triangle_tests = 3; }), HasSubstr("1 or 2 triangles"));
    EXPECT_THAT(fault([&](auto& c) { c.pair_tests[0].better_hits = 3; }), HasSubstr("than exact tests"));
    EXPECT_THAT(fault([&](auto& c) { c.pair_tests[0].side_tests = 3; }), HasSubstr("than exact tests"));
    EXPECT_THAT(fault([&](auto& c) { c.pair_tests.pop_back(); }), HasSubstr("pair tests"));
    EXPECT_THAT(fault([&](auto& c) { ++c.rays[0].visit_count; }), HasSubstr(""));
    EXPECT_NE(fault([&](auto& c) { ++c.rays[0].visit_count; }), "");
    EXPECT_THAT(fault([&](auto& c) { c.rays.back().visit_count = ~0U; }), HasSubstr("visits, got more"));
    EXPECT_THAT(fault([&](auto& c) { c.rays[5].hit = model::Hit{}; }), HasSubstr("a hit without a visit"));
}

// Before pair tests had their outcomes, byte 21 of a chunk was 0.
TEST(Visits, WithoutOutcomesAreRefused) {
    const auto image = image_of(triangle_soup(300, 5, 0.2F));
    std::string payload = encode(example(RayKind::ClosestHit, image, 5));
    const auto decode = [&] {
        return error_of(
            [&] { static_cast<void>(traces::decode_visit_chunk(payload, traces::image_facts(image))); });
    };
    EXPECT_EQ(decode(), "");
    const std::size_t variant = payload.find('\1', 32);
    payload[variant] = 0;
    EXPECT_THAT(decode(), testing::HasSubstr("record them again"));
}

TEST(Visits, KeepTheHitsOfQuantisedBoxesOnly) {
    const auto image = image_of(triangle_soup(300, 5, 0.2F), {4, 1, model::NodeFormat::Quantised});
    const auto facts = traces::image_facts(image);
    const VisitChunk written = example(RayKind::ClosestHit, image, 400);
    const VisitChunk read = traces::decode_visit_chunk(encode(written), facts);
    ASSERT_EQ(read.visits.size(), written.visits.size());
    std::uint32_t extra = 0;
    for (std::size_t i = 0; i < read.visits.size(); ++i) {
        ASSERT_EQ(read.visits[i].extra_hits, written.visits[i].extra_hits);
        extra += read.visits[i].extra_hits;
    }
    EXPECT_GT(extra, 10U);
    VisitChunk bad = written;
    for (traces::Visit& visit : bad.visits) visit.extra_hits = visit.pushes;
    EXPECT_EQ(error_of([&] { static_cast<void>(traces::decode_visit_chunk(encode(bad), facts)); }), "");
    for (traces::Visit& visit : bad.visits) ++visit.extra_hits;
    EXPECT_NE(error_of([&] { static_cast<void>(traces::decode_visit_chunk(encode(bad), facts)); }), "");
}

TEST(Visits, ManyRaysAreSplitIntoChunks) {
    const auto image = image_of(triangle_soup(300, 5, 0.2F));
    RayChunk rays{"w", RayKind::ClosestHit, traces::IdKind::None, 10, rays_into_cube(2500), {}};
    const auto chunks = record_visits(rays, image);
    std::uint64_t next = 10;
    for (const VisitChunk& chunk : chunks) {
        EXPECT_EQ(chunk.first_ray, next);
        next += chunk.rays.size();
    }
    EXPECT_EQ(next, 2510U);
    EXPECT_GT(chunks.size(), 1U);
}

}  // namespace
}  // namespace rtu::test
