#include <gtest/gtest.h>

#include <numeric>

#include "machine_fixture.hpp"
#include "mock_units.hpp"
#include "sim/box_unit.hpp"
#include "sim/hit_sink.hpp"
#include "sim/kernel.hpp"
#include "sim/pair_unit.hpp"
#include "sim/ray_scheduler.hpp"
#include "sim/ray_source.hpp"

namespace rtu::sim {
namespace {

using model::RayKind;
using test::MockSink;
using test::MockSource;
using test::Stamped;

// `count` tokens, slots 0, 1, ..., offered from cycle 0 on.
std::vector<Stamped<MemoryReply>> tokens(std::uint32_t count) {
    std::vector<Stamped<MemoryReply>> script;
    for (std::uint32_t slot = 0; slot < count; ++slot) script.push_back({0, {.address = 0, .tag = slot}});
    return script;
}

std::vector<RaySlot> started_slots(std::uint32_t count, const model::MemoryImage& image,
                                   const model::Ray& ray) {
    std::vector<RaySlot> slots(count);
    for (RaySlot& slot : slots) EXPECT_TRUE(slot.walk.start(image, {ray, {}}, RayKind::ClosestHit));
    return slots;
}

constexpr std::size_t wide_channel = 64;  // never the limit

struct UnitRun {
    std::vector<Cycle> arrivals;  // at the sink, in order
    CycleAccount account;
    Cycle cycles = 0;
};

// Runs a unit between a source of tokens and a sink that is open when told to be.
template <class Unit, class Config>
UnitRun run_unit(const Config& config, std::vector<RaySlot>& slots, std::size_t depth_out = wide_channel,
                 const std::function<bool(Cycle)>& is_open = {}) {
    start_fresh_kernel();
    ClockDomain domain("domain", ClockMode::Fast, 100'000);
    Fifo<MemoryReply> in("in", wide_channel, domain);
    Fifo<SlotToken> out("out", depth_out, domain);
    MockSource<MemoryReply> source("source", domain, tokens(std::uint32_t(slots.size())));
    Unit unit("unit", domain, config, slots);
    MockSink<SlotToken> sink("sink", domain, is_open);
    source.out(in);
    if constexpr (std::is_same_v<Unit, BoxUnit>) {
        unit.nodes_in(in);
    } else {
        unit.leaves_in(in);
    }
    unit.results_out(out);
    sink.in(out);
    UnitRun run;
    run.cycles = domain.run([&] { return sink.received().size() == slots.size(); });
    for (const auto& [cycle, token] : sink.received()) run.arrivals.push_back(cycle);
    run.account = unit.cycle_account();
    return run;
}

// A node with four children, and a ray that enters none: the root of four far apart triangles.
struct FourBoxes {
    model::TriangleMesh mesh{"four", {}, {}};
    model::MemoryImage image;
    model::Ray ray{{0, 50, 0}, 0, {1, 0, 0}, 1e30F};
    FourBoxes() {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const float x = 10 * float(i);
            mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 1}});
            mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        image = test::image_of(mesh);
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
    const UnitRun run = run_unit<BoxUnit>(config, slots);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t nodes_per_cycle = std::max(1U, GetParam() / 4);
        const std::uint32_t cycles_per_node = (4 + GetParam() - 1) / GetParam();
        const Cycle last_issue = GetParam() >= 4 ? k / nodes_per_cycle : (k + 1) * cycles_per_node - 1;
        ASSERT_EQ(run.arrivals[k], 1 + last_issue + config.latency_cycles + 1) << "result " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, BoxRate, testing::Values(1, 2, 3, 4, 5, 8, 12, 16));

TEST(BoxUnit, WaitsForAFullSinkAndLosesNothing) {
    const FourBoxes scene;
    auto slots = started_slots(60, scene.image, scene.ray);
    const Config::Rtu::Box config{.boxes_per_cycle = 4, .latency_cycles = 12};
    const UnitRun run = run_unit<BoxUnit>(config, slots, 2, [](Cycle now) { return now % 40 == 0; });
    EXPECT_EQ(run.arrivals.size(), 60U);
    EXPECT_GT(run.account.blocked, 0U);
    EXPECT_EQ(run.account.busy, 60U);
    EXPECT_EQ(run.account.total(), run.cycles);
}

// A folded pair whose two triangles are both pierced, at the root's only leaf; and rays that stand before
// that leaf.
struct OnePair {
    model::TriangleMesh mesh;
    model::MemoryImage image;
    std::vector<RaySlot> slots;
    OnePair(bool is_folded, std::uint32_t count)
        : mesh{"pair",
               {{-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, is_folded ? test::Vec3{1, -1, 2} : test::Vec3{-2, 1, 1}},
               {{0, 1, 2}, {0, 2, 3}}},
          image(test::image_of(mesh)),
          slots(started_slots(count, image, {{-0.5F, -0.5F, 0}, 0, {0, 0, 1}, 1e30F})) {
        for (RaySlot& slot : slots) {
            slot.walk.visit_node();
            EXPECT_TRUE(slot.walk.pop());
        }
    }
};

TEST(PairUnit, AnswersExactlyAfterItsLatency) {
    for (const std::uint32_t latency : {1U, 9U, 22U}) {
        OnePair scene(false, 1);
        const Config::Rtu::Pair config{PairMode::DualShared, 1, 1, latency, 1};
        EXPECT_EQ(run_unit<PairUnit>(config, scene.slots).arrivals, std::vector<Cycle>{2 + latency});
    }
}

struct PairCase {
    PairMode mode;
    bool is_folded;
    std::uint32_t ii, replay;
    std::uint32_t held;   // cycles that a pair holds its tester
    std::uint32_t extra;  // cycles that its result is late
};

void PrintTo(const PairCase& c, std::ostream* out) {
    *out << "mode " << int(c.mode) << (c.is_folded ? ", folded" : "") << ", interval " << c.ii << ", replay "
         << c.replay;
}

class PairRate : public testing::TestWithParam<PairCase> {};

TEST_P(PairRate, IsThatOfItsModeAndInterval) {
    const auto [mode, is_folded, ii, replay, held, extra] = GetParam();
    for (const std::uint32_t testers : {1U, 2U}) {
        constexpr std::uint32_t count = 40, latency = 22;
        OnePair scene(is_folded, count);
        const UnitRun run =
            run_unit<PairUnit>(Config::Rtu::Pair{mode, testers, ii, latency, replay}, scene.slots);
        for (std::uint32_t k = 0; k < count; ++k) {
            ASSERT_EQ(run.arrivals[k], 1 + k / testers * held + extra + latency + 1) << "result " << k;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, PairRate,
                         testing::Values(PairCase{PairMode::Single, false, 1, 1, 2, 1},
                                         PairCase{PairMode::Single, false, 3, 1, 6, 3},
                                         PairCase{PairMode::Single, true, 1, 1, 2, 1},
                                         PairCase{PairMode::DualIndependent, false, 1, 1, 1, 0},
                                         PairCase{PairMode::DualIndependent, true, 4, 1, 4, 0},
                                         PairCase{PairMode::DualShared, false, 1, 1, 1, 0},
                                         PairCase{PairMode::DualShared, true, 1, 1, 2, 1},
                                         PairCase{PairMode::DualShared, true, 2, 3, 5, 3}));

TEST(PairUnit, WaitsForAFullSinkAndLosesNothing) {
    OnePair scene(true, 60);
    const UnitRun run = run_unit<PairUnit>(Config::Rtu::Pair{PairMode::DualShared, 1, 1, 22, 1}, scene.slots,
                                           2, [](Cycle now) { return now % 100 == 0; });
    EXPECT_EQ(run.arrivals.size(), 60U);
    EXPECT_GT(run.account.blocked, 0U);
    EXPECT_EQ(run.account.busy, 120U);
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
