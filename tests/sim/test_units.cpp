#include <gtest/gtest.h>

#include "machine_fixture.hpp"
#include "mock_units.hpp"
#include "sim/box_unit.hpp"
#include "sim/hit_sink.hpp"
#include "sim/kernel.hpp"
#include "sim/ray_scheduler.hpp"
#include "sim/ray_source.hpp"
#include "unit_rig.hpp"

namespace rtu::sim {
namespace {

using model::RayKind;
using test::MockSink;
using test::MockSource;
using test::run_unit;
using test::started_slots;

// A node with four children, and a ray that enters none: the root of four far apart triangles.
struct FourBoxes {
    model::TriangleMesh mesh{"four", {}, {}};
    model::MemoryImage image;
    model::Ray ray{{0, 50, 0}, 0, {1, 0, 0}, 1e30F};
    explicit FourBoxes(std::uint32_t width = 4) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const float x = 10 * float(i);
            mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 1}});
            mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        image = test::image_of(mesh, {.width = width});
    }
};

TEST(BoxUnit, AnswersExactlyAfterItsLatency) {
    const FourBoxes scene;
    for (const std::uint32_t latency : {1U, 7U, 12U}) {
        auto slots = started_slots(1, scene.image, scene.ray);
        const Config::Rtu::Box config{.boxes_per_cycle = 4, .latency_cycles = latency};
        // Pushed in 0, seen in 1, pushed in 1 + latency, seen one later.
        EXPECT_EQ(run_unit<BoxUnit>(config, slots).arrivals, std::vector<Cycle>{2 + latency});
    }
}

class BoxRate : public testing::TestWithParam<std::uint32_t> {};

TEST_P(BoxRate, IsThatOfItsLanes) {
    const FourBoxes scene;
    constexpr std::uint32_t count = 48;
    auto slots = started_slots(count, scene.image, scene.ray);
    const Config::Rtu::Box config{.boxes_per_cycle = GetParam(), .latency_cycles = 12};
    const auto run = run_unit<BoxUnit>(config, slots);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t nodes_per_cycle = std::max(1U, GetParam() / 4);
        const std::uint32_t cycles_per_node = (4 + GetParam() - 1) / GetParam();
        const Cycle last_issue = GetParam() >= 4 ? k / nodes_per_cycle : (k + 1) * cycles_per_node - 1;
        ASSERT_EQ(run.arrivals[k], 1 + last_issue + config.latency_cycles + 1) << "result " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, BoxRate, testing::Values(1, 2, 3, 4, 5, 8, 12, 16));

TEST(BoxUnit, GivesIdleLanesToTheNextNodeOnlyWhenItPacks) {
    const FourBoxes scene(8);
    constexpr std::uint32_t count = 20;
    for (const std::uint32_t nodes_per_cycle : {1U, 2U}) {
        auto slots = started_slots(count, scene.image, scene.ray);
        const Config::Rtu::Box config{
            .boxes_per_cycle = 8, .packs_nodes = nodes_per_cycle - 1, .latency_cycles = 12};
        EXPECT_EQ(run_unit<BoxUnit>(config, slots).arrivals.back(),
                  1 + (count - 1) / nodes_per_cycle + config.latency_cycles + 1);
    }
}

TEST(BoxUnit, WaitsForAFullSinkAndLosesNothing) {
    const FourBoxes scene;
    auto slots = started_slots(60, scene.image, scene.ray);
    const Config::Rtu::Box config{.boxes_per_cycle = 4, .latency_cycles = 12};
    const auto run = run_unit<BoxUnit>(
        config, slots, {.offered = {}, .depth_out = 2, .is_open = [](Cycle now) { return now % 40 == 0; }});
    EXPECT_EQ(run.arrivals.size(), 60U);
    EXPECT_GT(run.account.blocked, 0U);
    EXPECT_EQ(run.account.busy, 60U);
    EXPECT_EQ(run.account.total(), run.cycles);
}

TEST(RaySource, HandsRaysOutInTurnAtItsRate) {
    start_fresh_kernel();
    ClockDomain domain("domain", ClockMode::Fast, 1'000);
    Fifo<RayMessage> a("a", 2, domain), b("b", 2, domain);
    const std::vector<model::Ray> rays(10);
    SpanSupply supply(rays);
    RaySource source("source", domain, supply, 1, 2);
    MockSink<RayMessage> sink_a("sink_a", domain), sink_b("sink_b", domain);
    source.rays_out[0](a);
    source.rays_out[1](b);
    sink_a.in(a);
    sink_b.in(b);
    domain.run([&] { return sink_a.received().size() + sink_b.received().size() == 10; });
    for (std::uint32_t k = 0; k < 5; ++k) {
        EXPECT_EQ(sink_a.received()[k].item.ray_index, 2 * k);
        EXPECT_EQ(sink_a.received()[k].cycle, 2 * k + 1);
        EXPECT_EQ(sink_b.received()[k].item.ray_index, 2 * k + 1);
    }
}

TEST(HitSink, RefusesARayThatReturnsTwice) {
    start_fresh_kernel();
    ClockDomain domain("domain", ClockMode::Fast, 1'000);
    Fifo<HitMessage> hits("hits", 4, domain);
    MockSource<HitMessage> source("source", domain, {{0, {3, {}}}, {1, {3, {}}}});
    HitSink sink(
        "sink", domain, [](const auto&) {}, 1);
    source.out(hits);
    sink.hits_in[0](hits);
    EXPECT_THROW(domain.run([&] { return sink.received() == 2; }), std::logic_error);
}

// The scheduler alone: what it asks for, and when.
TEST(RayScheduler, AsksForTheRootOneCycleAfterItAcceptsARay) {
    start_fresh_kernel();
    const FourBoxes scene;
    ClockDomain domain("domain", ClockMode::Fast, 1'000);
    Fifo<RayMessage> in("in", 8, domain);
    Fifo<SlotToken> box_results("box_results", 2, domain), pair_results("pair_results", 2, domain);
    Fifo<MemoryReply> blocks("blocks", 2, domain);
    Fifo<MemoryRequest> requests("requests", 4, domain);
    Fifo<HitMessage> hits("hits", 2, domain);
    RaySlots slots(2);
    Config::Rtu config = Config{}.rtu;
    MockSource<RayMessage> source(
        "source", domain, {{0, {0, {scene.ray, {}}}}, {0, {1, {scene.ray, {}}}}, {0, {2, {scene.ray, {}}}}});
    RayScheduler scheduler("scheduler", domain, config, scene.image, RayKind::ClosestHit, slots, {});
    MockSink<MemoryRequest> sink("sink", domain);
    source.out(in);
    scheduler.rays_in(in);
    scheduler.box_results_in(box_results);
    scheduler.pair_results_in(pair_results);
    scheduler.stack_blocks_in(blocks);
    scheduler.requests_out(requests);
    scheduler.hits_out(hits);
    sink.in(requests);
    domain.run([&] { return sink.received().size() == 2; });
    // Two slots: the third ray waits. Accepted in 1 and 2, asked for in 2 and 3, seen one later.
    EXPECT_EQ(sink.received()[0].cycle, 3U);
    EXPECT_EQ(sink.received()[1].cycle, 4U);
    EXPECT_EQ(sink.received()[0].item.size_bytes, 128U);
    EXPECT_EQ(sink.received()[0].item.source, std::uint8_t(ReplyTo::BoxUnit));
    EXPECT_EQ(in.size(), 1U);
    EXPECT_EQ(scheduler.counters().rays_accepted, 2U);
    EXPECT_THROW(scheduler.check_drained(), std::logic_error);  // two rays are under way
}

}  // namespace
}  // namespace rtu::sim
