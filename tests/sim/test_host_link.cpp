#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "mock_units.hpp"
#include "sim/host_link.hpp"
#include "sim/kernel.hpp"
#include "sim/link_wire.hpp"
#include "tests/sim/machine_fixture.hpp"

namespace rtu::test {
namespace {

using sim::BatchArrival;
using sim::ClockMode;
using sim::HostLink;
using sim::LinkCounters;
using sim::LinkTimeline;
using sim::MemoryReply;
using sim::MemoryRequest;

constexpr std::uint32_t clock_mhz = 1000;  // a cycle is a nanosecond

sim::Config::Link slow_link() {
    sim::Config::Link link;
    link.count = 1;
    link.up_mb_per_second = 2000;  // 2 bytes a cycle
    link.down_mb_per_second = 300;
    link.latency_ns = 50;
    link.overhead_ns = 20;
    link.outstanding = 64;
    return link;
}

MemoryRequest up(std::uint64_t batch, std::uint32_t bytes) {
    return {.address = batch, .size_bytes = bytes, .is_write = true};
}
MemoryRequest down(std::uint64_t batch, std::uint32_t bytes) {
    return {.address = batch, .size_bytes = bytes};
}

struct LinkOutcome {
    Cycle cycles = 0;
    std::vector<Stamped<BatchArrival>> arrivals;
    std::vector<Stamped<MemoryReply>> replies;
    LinkCounters counters;
    sim::CycleAccount account;
    friend bool operator==(const LinkOutcome&, const LinkOutcome&) = default;
};

struct LinkSetup {
    sim::Config::Link link = slow_link();
    std::vector<Stamped<MemoryRequest>> script;
    ClockMode mode = ClockMode::Fast;
    bool is_reversed = false;
    std::function<bool(Cycle)> is_machine_open{};
};

// A scripted host at one end of a link, and sinks at the other.
LinkOutcome run(const LinkSetup& setup) {
    sim::start_fresh_kernel();
    ClockDomain clock("clock", setup.mode, 1'000'000);
    LinkTimeline timeline;
    Fifo<MemoryRequest> transfers("transfers", 256, clock);
    Fifo<BatchArrival> arrivals("arrivals", 2, clock);
    Fifo<MemoryReply> replies("replies", 2, clock);
    std::unique_ptr<HostLink> link;
    const auto make_link = [&] {
        link = std::make_unique<HostLink>("link", clock, setup.link, clock_mhz, timeline);
    };
    if (setup.is_reversed) make_link();
    MockSource<MemoryRequest> host("host", clock, setup.script);
    MockSink<BatchArrival> machine("machine", clock, setup.is_machine_open);
    MockSink<MemoryReply> results("results", clock);
    if (!setup.is_reversed) make_link();
    host.out(transfers);
    link->transfers_in(transfers);
    link->arrivals_out(arrivals);
    link->replies_out(replies);
    machine.in(arrivals);
    results.in(replies);
    LinkOutcome outcome;
    outcome.cycles = clock.run(
        [&] { return machine.received().size() + results.received().size() == setup.script.size(); });
    link->check_drained();
    outcome.arrivals = machine.received();
    outcome.replies = results.received();
    outcome.counters = link->counters();
    outcome.account = link->cycle_account();
    return outcome;
}

constexpr Cycle channels = 2;  // the one into the link and the one out of it

TEST(LinkWire, LosesNothingToRoundingBetweenTransfers) {
    sim::LinkWire wire(1000);
    Cycle sent_at = 0;
    for (int i = 0; i < 300; ++i) sent_at = wire.send(0, 1, 300);  // 10 / 3 cycles each
    EXPECT_EQ(sent_at, 1000U);
    EXPECT_EQ(wire.send(1000, 1, 300), 1004U);
    EXPECT_EQ(wire.send(0, 1, 2000), 1005U) << "another rate starts with a whole cycle";
}

TEST(LinkWire, TurnsNanosecondsIntoCyclesRoundingUp) {
    EXPECT_EQ(sim::cycles_of_ns(0, 400), 0U);
    EXPECT_EQ(sim::cycles_of_ns(1, 400), 1U);
    EXPECT_EQ(sim::cycles_of_ns(5, 400), 2U);
    EXPECT_EQ(sim::cycles_of_ns(1'000'000'000, 10'000), 10'000'000'000U);
}

TEST(HostLink, OneTransferTakesOverheadPlusBytesOverBandwidthPlusLatency) {
    LinkSetup setup;
    setup.script = {{0, up(7, 1001)}};
    const LinkOutcome outcome = run(setup);
    ASSERT_EQ(outcome.arrivals.size(), 1U);
    EXPECT_EQ(outcome.arrivals[0].item, (BatchArrival{7, 1001}));
    EXPECT_EQ(outcome.arrivals[0].cycle, 20 + 501 + 50 + channels);
    setup.script = {{0, down(9, 100)}};
    const LinkOutcome back = run(setup);
    ASSERT_EQ(back.replies.size(), 1U);
    EXPECT_EQ(back.replies[0].item.address, 9U);
    EXPECT_EQ(back.replies[0].cycle, 20 + 334 + 50 + channels);
}

TEST(HostLink, ManyLargeTransfersTakeAsLongAsTheirBytesAtFullBandwidth) {
    LinkSetup setup;
    for (std::uint64_t i = 0; i < 100; ++i) setup.script.push_back({0, up(i, 1001)});
    EXPECT_EQ(run(setup).arrivals.back().cycle, 20 + (100 * 1001 + 1) / 2 + 50 + channels);
}

TEST(HostLink, ManySmallTransfersTakeAsLongAsTheHostSpendsOnThem) {
    LinkSetup setup;
    for (std::uint64_t i = 0; i < 100; ++i) setup.script.push_back({0, up(i, 8)});
    EXPECT_EQ(run(setup).arrivals.back().cycle, 100 * 20 + 4 + 50 + channels);
}

TEST(HostLink, OneOutstandingTransferWaitsForTheOneBefore) {
    LinkSetup setup;
    setup.link.outstanding = 1;
    for (std::uint64_t i = 0; i < 10; ++i) setup.script.push_back({0, up(i, 8)});
    const LinkOutcome outcome = run(setup);
    EXPECT_EQ(outcome.arrivals.back().cycle, 10 * (20 + 4 + 50) + channels);
    EXPECT_EQ(outcome.counters.outstanding_full_cycles, 9 * (20 + 4 + 50));
}

TEST(HostLink, TwoWiresMoveBothDirectionsAtOnceAndOneTakesTurns) {
    LinkSetup setup;
    setup.script = {{0, up(0, 6000)}, {0, down(1, 900)}};  // 3000 cycles each
    EXPECT_EQ(run(setup).replies[0].cycle, 20 + 20 + 3000 + 50 + channels);
    setup.link.wires = 1;
    EXPECT_EQ(run(setup).replies[0].cycle, 20 + 3000 + 3000 + 50 + channels);
}

TEST(HostLink, CostsOnlyItsChannelsWhenThereIsNoLink) {
    LinkSetup setup;
    setup.link.count = 0;
    setup.script = {{0, up(0, 1'000'000'000)}, {5, down(1, 1'000'000'000)}};
    const LinkOutcome outcome = run(setup);
    EXPECT_EQ(outcome.arrivals[0].cycle, channels + 1);  // accepted in one tick, delivered in the next
    EXPECT_EQ(outcome.replies[0].cycle, 5 + channels + 1);
}

std::vector<Stamped<MemoryRequest>> random_script(std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    std::vector<Stamped<MemoryRequest>> script;
    Cycle at = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        at += random.below(200);
        const auto bytes = 1 + random.below(500);
        script.push_back({at, random.below(2) == 0 ? up(i, bytes) : down(i, bytes)});
    }
    return script;
}

TEST(HostLink, ConservesTransfersAndBytesInTheirOrder) {
    LinkSetup setup;
    setup.script = random_script(300, 1);
    const LinkOutcome outcome = run(setup);
    std::vector<BatchArrival> sent_up, got_up;
    std::vector<std::uint64_t> sent_down, got_down;
    std::uint64_t up_bytes = 0, down_bytes = 0;
    for (const auto& [cycle, transfer] : setup.script) {
        if (transfer.is_write) {
            sent_up.push_back({transfer.address, transfer.size_bytes});
            up_bytes += transfer.size_bytes;
        } else {
            sent_down.push_back(transfer.address);
            down_bytes += transfer.size_bytes;
        }
    }
    for (const auto& arrival : outcome.arrivals) got_up.push_back(arrival.item);
    for (const auto& reply : outcome.replies) got_down.push_back(reply.item.address);
    EXPECT_EQ(got_up, sent_up);
    EXPECT_EQ(got_down, sent_down);
    EXPECT_EQ(outcome.counters.up_transfers, sent_up.size());
    EXPECT_EQ(outcome.counters.down_transfers, sent_down.size());
    EXPECT_EQ(outcome.counters.up_bytes_arrived, up_bytes);
    EXPECT_EQ(outcome.counters.down_bytes_arrived, down_bytes);
    EXPECT_EQ(outcome.counters.overhead_cycles, 300U * 20);
}

TEST(HostLink, DoesNotDependOnTheOrderOfUnitsOrTheClockMode) {
    for (const std::uint32_t outstanding : {1U, 3U, 64U}) {
        for (const std::uint32_t wires : {1U, 2U}) {
            LinkSetup setup;
            setup.link.outstanding = outstanding;
            setup.link.wires = wires;
            setup.script = random_script(200, outstanding);
            setup.is_machine_open = [](Cycle now) { return now % 700 < 300; };
            const LinkOutcome forward = run(setup);
            EXPECT_EQ(forward.account.total(), forward.cycles);
            EXPECT_GT(forward.account.starved, 0U) << "the time jumps over waiting cycles";
            setup.is_reversed = true;
            EXPECT_EQ(run(setup), forward);
            setup.mode = ClockMode::Verify;
            EXPECT_EQ(run(setup), forward);
        }
    }
}

TEST(HostLink, IsBusyWhileTheHostOrAWireIs) {
    LinkSetup setup;
    setup.script = {{0, up(0, 1000)}};
    const LinkOutcome outcome = run(setup);
    // From the cycle of acceptance: 20 of the host and 500 on the wire; then the cycle of delivery.
    EXPECT_EQ(outcome.account.busy, 20U + 500 + 1);
    EXPECT_EQ(outcome.account.starved, 50U) << "on its way";
}

TEST(LinkTimeline, GivesEveryCycleToTheMachineElseToReadBackElseToUpload) {
    using Stage = LinkTimeline::Stage;
    LinkTimeline timeline;
    timeline.begin(Stage::Upload, 10);
    timeline.begin(Stage::Machine, 30);  // within a cycle the order does not matter
    timeline.end(Stage::Upload, 30);
    timeline.begin(Stage::ReadBack, 50);
    timeline.begin(Stage::Upload, 55);
    timeline.end(Stage::Machine, 60);
    timeline.end(Stage::ReadBack, 75);
    timeline.end(Stage::Upload, 76);
    const sim::LinkTime time = timeline.time_until(100);
    EXPECT_EQ(time, (sim::LinkTime{30, 15, 20 + 1, 10 + 24}));
    EXPECT_EQ(time.total(), 100U);
    timeline.begin(Stage::Upload, 100);
    EXPECT_THROW((void)timeline.time_until(101), std::logic_error);
}

struct Scene {
    model::MemoryImage image;
    std::vector<model::Ray> rays;
};

Scene small_scene() { return {image_of(triangle_soup(100, 3, 0.3F), {4, 1}), rays_into_unit_cube(500, 4)}; }

const sim::UnitResult& unit(const sim::MachineResult& result, std::string_view name) {
    const auto found = std::ranges::find(result.units, name, &sim::UnitResult::name);
    EXPECT_NE(found, result.units.end()) << name;
    return *found;
}

std::uint64_t counter(const sim::UnitResult& unit, std::string_view name) {
    const auto found = std::ranges::find(unit.counters, name, &sim::CounterValue::name);
    EXPECT_NE(found, unit.counters.end()) << name;
    return found->value;
}

TEST(LinkedMachine, GivesTheHitsAndCountsOfTheMachineWithoutALink) {
    const Scene scene = small_scene();
    sim::Config config = tiny_machine();
    const auto alone = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    for (const std::uint32_t batch_rays : {1U, 7U, 100U, 500U, 4096U}) {
        config.link = slow_link();
        config.link.batch_rays = batch_rays;
        const auto linked = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
        EXPECT_EQ(linked.hits, alone.hits);
        EXPECT_EQ(linked.counts, alone.counts);
        // Rays that come one by one meet less contention than all at once, so only the wire bounds a run.
        EXPECT_GT(linked.cycles, 500U * 32 / 2);
        const sim::UnitResult& link = unit(linked, "link");
        EXPECT_EQ(counter(link, "up_bytes_arrived"), 500U * 32);
        EXPECT_EQ(counter(link, "down_bytes_arrived"), 500U * 16);
        EXPECT_EQ(counter(link, "up_transfers"), (500 + batch_rays - 1) / batch_rays);
        EXPECT_EQ(counter(link, "down_transfers"), (500 + batch_rays - 1) / batch_rays);
    }
}

TEST(LinkedMachine, OfOneBatchTakesBothTransfersAndTheMachinesTime) {
    const Scene scene = small_scene();
    sim::Config config = tiny_machine();
    const auto alone = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    config.link = slow_link();
    const auto linked = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    const Cycle up_cycles = 20 + 500 * 32 / 2 + 50, down_cycles = 20 + (500 * 16 * 10 + 2) / 3 + 50;
    EXPECT_EQ(counter(unit(linked, "link"), "upload_cycles"), up_cycles);
    EXPECT_EQ(counter(unit(linked, "link"), "read_back_cycles"), down_cycles);
    // Channels: into the link and out of it up, the sink's word, the same down, and the host's own cycles.
    EXPECT_EQ(linked.cycles, alone.cycles + up_cycles + down_cycles + 2 * channels + 1);
}

TEST(LinkedMachine, DoesNotDependOnTheClockMode) {
    const Scene scene = small_scene();
    for (const std::uint32_t buffers : {1U, 2U, 5U}) {
        sim::Config config = tiny_machine();
        config.rtu.count = buffers == 2 ? 3 : 1;
        config.link = slow_link();
        config.link.batch_rays = 37;
        config.link.buffers = buffers;
        config.link.outstanding = 2;
        const auto fast = sim::simulate(config, scene.image, scene.rays, model::RayKind::AnyHit);
        const auto verified =
            sim::simulate(config, scene.image, scene.rays, model::RayKind::AnyHit, ClockMode::Verify);
        EXPECT_EQ(fast.cycles, verified.cycles);
        EXPECT_EQ(fast.hits, verified.hits);
        ASSERT_EQ(fast.units.size(), verified.units.size());
        for (std::size_t i = 0; i < fast.units.size(); ++i) {
            EXPECT_EQ(fast.units[i].cycles, verified.units[i].cycles) << fast.units[i].name;
            for (std::size_t c = 0; c < fast.units[i].counters.size(); ++c) {
                EXPECT_EQ(fast.units[i].counters[c].value, verified.units[i].counters[c].value)
                    << fast.units[i].name << ' ' << fast.units[i].counters[c].name;
            }
        }
    }
}

TEST(LinkedMachine, MoreBuffersHideTransfersBehindTheMachinesWork) {
    const Scene scene = small_scene();
    sim::Config config = tiny_machine();
    config.link = slow_link();
    config.link.batch_rays = 25;
    config.link.buffers = 1;
    const auto one = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    config.link.buffers = 2;
    const auto two = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    EXPECT_LT(two.cycles, one.cycles);
}

TEST(LinkedMachine, IsAsWithoutALinkWhenThereIsNone) {
    const Scene scene = small_scene();
    const sim::Config config = tiny_machine();
    const auto result = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    EXPECT_THAT(result.units,
                testing::Each(testing::Field(&sim::UnitResult::name,
                                             testing::AllOf(testing::Ne("host"), testing::Ne("link")))));
}

TEST(LinkedMachine, TransfersThatTakeLongerThanTheWatchdogAreProgress) {
    const Scene scene = small_scene();
    sim::Config config = tiny_machine();
    config.watchdog_cycles = 100'000;
    config.link = slow_link();
    config.link.latency_ns = 1'000'000;
    const auto result = sim::simulate(config, scene.image, scene.rays, model::RayKind::ClosestHit);
    EXPECT_GT(result.cycles, 2'000'000U);
}

TEST(LinkedMachine, WithoutRaysTakesNoCycle) {
    const Scene scene = small_scene();
    sim::Config config = tiny_machine();
    config.link = slow_link();
    const auto result =
        sim::simulate(config, scene.image, std::span<const model::Ray>{}, model::RayKind::ClosestHit);
    EXPECT_EQ(result.cycles, 0U);
    EXPECT_EQ(counter(unit(result, "link"), "up_transfers"), 0U);
}

}  // namespace
}  // namespace rtu::test
