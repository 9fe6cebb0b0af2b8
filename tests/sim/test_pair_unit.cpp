#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "machine_fixture.hpp"
#include "unit_rig.hpp"

namespace rtu::sim {
namespace {

using test::run_unit;
using test::started_slots;
using Pair = Config::Rtu::Pair;

// Rays at a leaf of two triangles; of each ray the first pass leaves as many triangles as are asked for.
struct OnePair {
    model::TriangleMesh mesh{
        "pair", {{-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {0, -1, 2}}, {{0, 1, 2}, {0, 2, 3}}};
    model::MemoryImage image = test::image_of(mesh);
    std::vector<RaySlot> slots;

    static constexpr std::uint32_t on_common_edge = 3;

    explicit OnePair(const std::vector<std::uint32_t>& left) {
        // In neither triangle, in the first, in both, and where their common edge x = -1 is.
        constexpr std::array<std::array<float, 2>, 4> places{
            {{0.9F, 0.9F}, {0.2F, -0.5F}, {-0.75F, -0.5F}, {-1, 0}}};
        for (const std::uint32_t triangles : left) {
            const auto [x, y] = places[triangles];
            auto one = started_slots(1, image, {{x, y, 0}, 0, {0, 0, 1}, 1e30F});
            one[0].walk.visit_node();
            EXPECT_TRUE(one[0].walk.pop());
            slots.push_back(one[0]);
        }
    }
    OnePair(std::uint32_t left, std::uint32_t count) : OnePair(std::vector(count, left)) {}
};

std::uint64_t total(const CycleAccount& account) { return account.total(); }

TEST(PairUnit, AnswersExactlyAfterItsLatency) {
    for (const std::uint32_t latency : {1U, 9U, 22U}) {
        OnePair scene(1, 1);
        const Pair config{.latency_cycles = latency, .hit_units = 0};
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
        OnePair scene(is_folded ? 2 : 1, count);
        const auto run = run_unit<PairUnit>(Pair{.mode = mode,
                                                 .testers = testers,
                                                 .ii_cycles = ii,
                                                 .latency_cycles = latency,
                                                 .replay_cycles = replay,
                                                 .hit_units = 0},
                                            scene.slots);
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
    OnePair scene(2, 60);
    const auto run = run_unit<PairUnit>(
        Pair{.latency_cycles = 22, .replay_cycles = 1, .hit_units = 0}, scene.slots,
        {.offered = {}, .depth_out = 2, .is_open = [](Cycle now) { return now % 100 == 0; }});
    EXPECT_EQ(run.arrivals.size(), 60U);
    EXPECT_GT(run.account.blocked, 0U);
    EXPECT_EQ(run.account.busy, 120U);
}

// What passes the first pass holds a hit unit; of the two triangles both become the best hit in their turn
// only if the second is nearer, which it is not here.
const Pair with_hit_units{.latency_cycles = 33,
                          .hit_units = 3,
                          .hit_cycles = 20,
                          .reject_cycles = 15,
                          .side_cycles = 7,
                          .entries = 100};

// Of a leaf seen in cycle 1: a result is seen a cycle after it left, and a hit unit can start two cycles
// after the first pass.
constexpr Cycle queue_cycles = 2;
const Cycle end_of_first_pass = 1 + with_hit_units.latency_cycles;
const Cycle start_of_first = end_of_first_pass + queue_cycles;

TEST(HitUnits, HoldWhatTheFirstPassLeft) {
    for (const PairMode mode : {PairMode::Single, PairMode::DualIndependent, PairMode::DualShared}) {
        Pair config = with_hit_units;
        config.mode = mode;
        const Cycle late = mode == PairMode::Single ? 1 : 0;
        const auto arrival = [&](std::uint32_t left) {
            OnePair scene(left, 1);
            return run_unit<PairUnit>(config, scene.slots).arrivals.front();
        };
        EXPECT_EQ(arrival(0), end_of_first_pass + late + 1);
        EXPECT_EQ(arrival(1), start_of_first + late + config.hit_cycles + 1);
        EXPECT_EQ(arrival(2), start_of_first + late + config.hit_cycles + config.reject_cycles + 1);
    }
}

// A ray through the common edge, whose side binary32 cannot tell: both triangles are left, one is hit.
TEST(HitUnits, AreHeldLongerForOpenSides) {
    OnePair scene({OnePair::on_common_edge});
    const auto run = run_unit<PairUnit>(with_hit_units, scene.slots);
    const Pair& c = with_hit_units;
    EXPECT_EQ(run.arrivals.front(), start_of_first + c.hit_cycles + c.reject_cycles + 2 * c.side_cycles + 1);
}

TEST(HitUnits, AreOvertakenByMisses) {
    OnePair scene({2, 1, 0, 0});
    const auto run = run_unit<PairUnit>(with_hit_units, scene.slots);
    EXPECT_EQ(run.slots, (std::vector<std::uint32_t>{2, 3, 1, 0}));
}

class HitUnitRate : public testing::TestWithParam<std::uint32_t> {};

// One starts a cycle; a unit starts again in the cycle after its result left.
TEST_P(HitUnitRate, IsThatOfTheUnits) {
    constexpr std::uint32_t count = 60;
    Pair config = with_hit_units;
    config.hit_units = GetParam();
    OnePair scene(1, count);
    const auto run = run_unit<PairUnit>(config, scene.slots);
    const std::uint32_t period = config.hit_cycles + 1, at_once = std::min(GetParam(), period);
    std::uint64_t waited = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        const Cycle start = start_of_first + k / at_once * period + k % at_once;
        ASSERT_EQ(run.arrivals[k], start + config.hit_cycles + 1) << "result " << k;
        waited += start - (start_of_first + k);
    }
    EXPECT_EQ(run.counters.survivors, count);
    EXPECT_EQ(run.counters.hit_unit_cycles, count * period);
    EXPECT_EQ(run.counters.hit_wait_cycles, waited);
    EXPECT_EQ(run.counters.replays, 0U);
    EXPECT_EQ(run.counters.standing_cycles, 0U);
    EXPECT_EQ(run.account.busy, count);
    EXPECT_EQ(total(run.account), run.cycles);
}

INSTANTIATE_TEST_SUITE_P(Units, HitUnitRate, testing::Values(1, 2, 3, 8, 20, 21, 22, 40));

// With room for four, the fifth enters in the cycle after the first has left.
TEST(HitUnits, TakeNoMoreLeavesThanThereAreEntries) {
    Pair config = with_hit_units;
    config.entries = 4;
    OnePair scene({1, 1, 1, 1, 0});
    const auto run = run_unit<PairUnit>(config, scene.slots);
    const Cycle left = start_of_first + config.hit_cycles;
    EXPECT_EQ(run.arrivals[0], left + 1);
    EXPECT_EQ(run.slots.back(), 4U);
    EXPECT_EQ(run.arrivals.back(), left + 1 + config.latency_cycles + 1);
    // Seen in 5, it waits until it enters.
    EXPECT_EQ(run.account.blocked, left + 1 - 5);
    EXPECT_EQ(run.account.busy, 5U);
}

// A stand-still closes no gap: leaves that entered eight cycles apart leave eight cycles apart.
TEST(HitUnits, FirstPassMovesAsAWhole) {
    for (const std::uint32_t units : {0U, 3U}) {
        OnePair scene(0, 4);
        Pair config = with_hit_units;
        config.hit_units = units;
        const auto run = run_unit<PairUnit>(
            config, scene.slots,
            {.offered = {0, 0, 0, 10}, .depth_out = 2, .is_open = [](Cycle now) { return now >= 100; }});
        // The third enters in 3 and the fourth in 11. Two fill the channel; in 101 it has room again.
        const Cycle third = 101, fourth = units == 0 ? third : third + 8;
        EXPECT_EQ(run.arrivals, (std::vector<Cycle>{100, 100, third + 1, fourth + 1})) << units << " units";
        EXPECT_EQ(run.counters.standing_cycles, units == 0 ? 0 : third - (3 + config.latency_cycles));
    }
}

// A miss that cannot leave holds up the survivors behind it, and nothing enters.
TEST(HitUnits, WaitBehindAMissThatStands) {
    OnePair scene({0, 0, 0, 1, 1});
    const auto run = run_unit<PairUnit>(
        with_hit_units, scene.slots,
        {.offered = {0, 0, 0, 0, 36}, .depth_out = 2, .is_open = [](Cycle now) { return now >= 100; }});
    const Cycle hold = with_hit_units.hit_cycles, third = 101, fourth = third + 1 + queue_cycles + hold;
    EXPECT_EQ(run.slots, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(run.arrivals[2], third + 1);
    EXPECT_EQ(run.arrivals[3], fourth + 1);
    // Seen in 37, the last enters when the first pass moves again.
    EXPECT_EQ(run.arrivals[4], third + with_hit_units.latency_cycles + queue_cycles + hold + 1);
    EXPECT_EQ(run.account.blocked, third - 37);
}

// One result a cycle: that of a hit unit first, and the first pass stands meanwhile.
TEST(HitUnits, GiveTheirResultBeforeAMiss) {
    const Pair& config = with_hit_units;
    std::vector<std::uint32_t> left(1 + queue_cycles + config.hit_cycles + 5, 0);
    left[0] = 1;
    OnePair scene(left);
    const auto run = run_unit<PairUnit>(config, scene.slots);
    const Cycle hit = start_of_first + config.hit_cycles;
    for (std::size_t k = 0; k < left.size(); ++k) {
        ASSERT_EQ(run.arrivals[k], end_of_first_pass + 1 + k + 1) << "result " << k;
        ASSERT_EQ(run.slots[k] == 0, run.arrivals[k] == hit + 1);
    }
    EXPECT_EQ(run.counters.standing_cycles, 1U);
}

// A miss that is offered stays offered: a hit unit that is done meanwhile waits for it.
TEST(HitUnits, DoNotOvertakeAMissThatIsOffered) {
    OnePair scene({1, 0, 0, 0});
    const auto run =
        run_unit<PairUnit>(with_hit_units, scene.slots,
                           {.offered = {}, .depth_out = 2, .is_open = [](Cycle now) { return now >= 100; }});
    EXPECT_EQ(run.slots, (std::vector<std::uint32_t>{1, 2, 3, 0}));
    EXPECT_EQ(run.arrivals, (std::vector<Cycle>{100, 100, 102, 103}));
}

// Random leaves, a sink that is often closed, and several testers: nothing is lost, both clocks agree, and
// every cycle is accounted for.
TEST(HitUnits, LoseNothingWhateverStandsInTheWay) {
    test::Random random(71);
    for (int round = 0; round < 40; ++round) {
        std::vector<std::uint32_t> left(60);
        std::vector<Cycle> offered(left.size());
        for (std::uint32_t& triangles : left) triangles = random.below(3);
        for (Cycle& cycle : offered) cycle = random.below(400);
        std::ranges::sort(offered);
        const Pair config{.mode = PairMode(random.below(3)),
                          .testers = 1 + random.below(3),
                          .ii_cycles = 1 + random.below(3),
                          .latency_cycles = 1 + random.below(40),
                          .hit_units = 1 + random.below(4),
                          .hit_cycles = 1 + random.below(30),
                          .reject_cycles = 1 + random.below(20),
                          .entries = 1 + random.below(30)};
        const std::uint32_t open_every = 1 + random.below(6);
        const auto run_once = [&](ClockMode mode) {
            OnePair scene(left);
            return run_unit<PairUnit>(config, scene.slots,
                                      {.offered = offered,
                                       .depth_out = 2,
                                       .is_open = [=](Cycle now) { return now % open_every == 0; },
                                       .mode = mode});
        };
        const auto run = run_once(ClockMode::Fast), verify = run_once(ClockMode::Verify);
        std::vector<std::uint32_t> slots = run.slots;
        std::ranges::sort(slots);
        for (std::uint32_t slot = 0; slot < slots.size(); ++slot) ASSERT_EQ(slots[slot], slot);
        const auto survivors = left.size() - std::size_t(std::ranges::count(left, 0U));
        const auto twice = std::size_t(std::ranges::count(left, 2U));
        ASSERT_EQ(run.counters.survivors, survivors);
        ASSERT_EQ(run.counters.replays, twice);
        ASSERT_GE(run.counters.hit_unit_cycles,
                  survivors * (config.hit_cycles + 1) + twice * config.reject_cycles);
        ASSERT_EQ(total(run.account), run.cycles);
        ASSERT_EQ(run.arrivals, verify.arrivals);
        ASSERT_EQ(run.slots, verify.slots);
        ASSERT_EQ(run.account, verify.account);
        ASSERT_EQ(run.counters, verify.counters);
    }
}

}  // namespace
}  // namespace rtu::sim
