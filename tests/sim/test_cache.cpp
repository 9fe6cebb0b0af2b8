#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cache_rig.hpp"

namespace rtu::test {
namespace {

using testing::ElementsAre;

constexpr std::uint64_t line_bytes = 128;
constexpr std::uint64_t set_stride = 4 * line_bytes;  // next line of the same set
constexpr std::uint32_t hop_cycles = 1;               // a channel: pushed in t, seen in t + 1

// From the push of a read to the reception of its reply.
Cycle hit_cycles(const CacheSetup& setup) { return hop_cycles + setup.config.latency_cycles + hop_cycles; }
// A fill is seen this long after its access was accepted.
Cycle fill_cycles(const CacheSetup& setup) { return hop_cycles + setup.memory_latency_cycles + hop_cycles; }
Cycle miss_cycles(const CacheSetup& setup) { return hit_cycles(setup) + fill_cycles(setup); }

std::vector<Cycle> reply_cycles(const CacheOutcome& outcome, std::size_t channel = 0) {
    std::vector<Cycle> cycles;
    for (const auto& reply : outcome.received[channel]) cycles.push_back(reply.cycle);
    return cycles;
}

std::vector<MemoryRequest> requests_below(const CacheOutcome& outcome) {
    std::vector<MemoryRequest> requests;
    for (const auto& request : outcome.below) {
        requests.push_back(request.item);
        requests.back().tag = 0;
    }
    return requests;
}

TEST(Cache, RepliesToAHitExactlyAfterItsLatency) {
    const CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(0)}, {500, read(0)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_EQ(outcome.received[0].at(1).cycle, 500 + hit_cycles(setup));
    EXPECT_EQ(outcome.counters.hits, 1U);
}

TEST(Cache, RepliesToAMissAfterTheRoundTripBelowAndItsLatency) {
    const CacheSetup setup{.config = small_cache(), .scripts = {{{10, read(0)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(10 + miss_cycles(setup)));
    EXPECT_EQ(outcome.below.at(0).cycle, 10 + hop_cycles + hop_cycles);
    EXPECT_EQ(outcome.counters.misses, 1U);
}

TEST(Cache, ServesOneAccessABankAndCycle) {
    // The first two share a bank; the last two use both.
    CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(0)}, {0, read(line_bytes)}}}};
    for (const std::uint64_t address : {0, 32, 64}) setup.scripts[0].push_back({500, read(address & 32)});
    setup.scripts[0].push_back({600, read(0)});
    setup.scripts[0].push_back({600, read(line_bytes)});
    const Script warm{{0, read(0, 128)}, {0, read(line_bytes, 128)}};
    std::copy(warm.begin(), warm.end(), setup.scripts[0].begin());
    const CacheOutcome outcome = run(setup);
    const std::vector<Cycle> cycles = reply_cycles(outcome);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(cycles.at(2 + k), 500 + hit_cycles(setup) + k);
    EXPECT_EQ(cycles.at(5), 600 + hit_cycles(setup));
    EXPECT_EQ(cycles.at(6), 600 + hit_cycles(setup));
    EXPECT_EQ(outcome.counters.bank_conflict_cycles, 2U);
}

TEST(Cache, RepliesOnceWhenAllLinesOfARequestHaveArrived) {
    // Line 0 is there, line 1 is not; then both are.
    const CacheSetup setup{
        .config = small_cache(),
        .scripts = {{{0, read(0, 128, 1)}, {500, read(64, 128, 2)}, {1000, read(64, 128, 3)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(reply_cycles(outcome),
                ElementsAre(miss_cycles(setup), 500 + miss_cycles(setup), 1000 + hit_cycles(setup)));
    EXPECT_EQ(outcome.received[0].at(1).item, (MemoryReply{64, 2}));
    EXPECT_THAT(requests_below(outcome), ElementsAre(read(0, 128), read(128, 64)));
    EXPECT_EQ(outcome.counters.line_reads, 5U);
    EXPECT_EQ(outcome.counters.hits, 3U);
}

TEST(Cache, SendsEachReplyToItsSource) {
    CacheSetup setup{.config = small_cache(), .reply_count = 3};
    setup.scripts = {{{0, read(0, 32, 5, 2)}, {100, read(0, 32, 6, 0)}, {200, read(0, 32, 7, 1)}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_EQ(outcome.received[2].at(0).item.tag, 5U);
    EXPECT_EQ(outcome.received[0].at(0).item.tag, 6U);
    EXPECT_EQ(outcome.received[1].at(0).item.tag, 7U);
}

TEST(Cache, FetchesOnlyMissingSectors) {
    const CacheSetup setup{.config = small_cache(),
                           .scripts = {{{0, read(64)}, {200, read(64, 64)}, {400, read(0, 128)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(requests_below(outcome), ElementsAre(read(64, 32), read(96, 32), read(0, 64)));
    EXPECT_EQ(outcome.counters.misses, 3U);
    EXPECT_EQ(outcome.counters.bytes_from_below, 128U);
}

TEST(Cache, AsksOnceForAllMissingSectorsEvenAroundOneThatItHas) {
    const CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(32)}, {200, read(0, 128)}}}};
    EXPECT_THAT(requests_below(run(setup)), ElementsAre(read(32, 32), read(0, 128)));
}

TEST(Cache, ReplacesTheLeastRecentlyUsedLine) {
    const std::uint64_t a = 0, b = set_stride, c = 2 * set_stride;
    CacheSetup setup{.config = small_cache(), .scripts = {{}}};
    Cycle when = 0;
    for (const std::uint64_t address : {a, b, a, c, a, b})
        setup.scripts[0].push_back({when += 200, read(address)});
    const CacheOutcome outcome = run(setup);
    // b was older than a when c came, so a still hits and b does not.
    EXPECT_THAT(requests_below(outcome), ElementsAre(read(a), read(b), read(c), read(b)));
    EXPECT_EQ(outcome.counters.hits, 2U);
    EXPECT_EQ(outcome.counters.evictions, 2U);
}

TEST(Cache, MergesReadsOfALineThatIsOnItsWay) {
    const CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(0)}, {5, read(0)}, {6, read(0)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(requests_below(outcome), ElementsAre(read(0)));
    // The fill answers one access a cycle.
    const Cycle first = miss_cycles(setup);
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(first, first + 1, first + 2));
    EXPECT_EQ(outcome.counters.mshr_merges, 2U);
}

TEST(Cache, AsksForFurtherSectorsOfALineThatIsOnItsWay) {
    const CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(0)}, {5, read(0, 64)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(requests_below(outcome), ElementsAre(read(0), read(32)));
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(miss_cycles(setup), 5 + miss_cycles(setup)));
    EXPECT_EQ(outcome.counters.misses, 2U);
}

TEST(Cache, WaitsForAnMshr) {
    CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(0)}, {0, read(line_bytes)}}}};
    setup.config.mshrs = 1;
    const CacheOutcome outcome = run(setup);
    // The second access is accepted in the cycle in which the first one's fill is taken.
    EXPECT_EQ(outcome.counters.mshr_full_cycles, fill_cycles(setup));
    EXPECT_THAT(reply_cycles(outcome),
                ElementsAre(miss_cycles(setup), miss_cycles(setup) + fill_cycles(setup)));
}

TEST(Cache, WaitsForATargetEntry) {
    CacheSetup setup{.config = small_cache(), .scripts = {{{0, read(0)}, {0, read(0)}}}};
    setup.config.targets_per_mshr = 1;
    const CacheOutcome outcome = run(setup);
    EXPECT_EQ(outcome.counters.mshr_merges, 0U);
    EXPECT_EQ(outcome.counters.hits, 1U);
    // In the cycle of the fill the bank is taken; from the first cycle, one was lost to the bank as well.
    EXPECT_EQ(outcome.counters.target_full_cycles, fill_cycles(setup) - 1);
    EXPECT_EQ(outcome.counters.bank_conflict_cycles, 2U);
}

TEST(Cache, NeverReplacesALineThatIsOnItsWay) {
    CacheSetup setup{.config = small_cache(), .scripts = {{}}};
    for (std::uint64_t way = 0; way < 3; ++way) setup.scripts[0].push_back({way, read(way * set_stride)});
    const CacheOutcome outcome = run(setup);
    EXPECT_EQ(outcome.counters.evictions, 1U);
    // Request 2 is seen two cycles after request 0; its way is free once that one's fill, and its bank once
    // the other's fill in the next cycle, is taken.
    EXPECT_EQ(outcome.counters.set_full_cycles, fill_cycles(setup) - 2);
    EXPECT_EQ(outcome.counters.bank_conflict_cycles, 2U);
}

TEST(Cache, WaitsForRoomBelow) {
    CacheSetup setup{.config = small_cache(), .scripts = {{}}, .channel_depth = 1};
    setup.config.banks = 1;
    for (std::uint64_t i = 0; i < 2; ++i) setup.scripts[0].push_back({0, read(i * line_bytes)});
    const CacheOutcome narrow = run(setup);
    setup.channel_depth = 16;
    const CacheOutcome wide = run(setup);
    EXPECT_EQ(narrow.below.at(0).cycle, wide.below.at(0).cycle);
    EXPECT_GT(narrow.below.at(1).cycle, wide.below.at(1).cycle);
}

TEST(Cache, WritesWithoutFetchingAndHitsWhatWasWritten) {
    const CacheSetup setup{.config = small_cache(), .scripts = {{{0, write(32)}, {1, read(32)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_TRUE(outcome.below.empty());
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(1 + hit_cycles(setup)));
}

TEST(Cache, WritesBackEachRunOfDirtySectorsOfAReplacedLine) {
    CacheSetup setup{.config = small_cache(), .scripts = {{{0, write(0, 64)}, {1, write(96)}}}};
    for (std::uint64_t way = 1; way <= 2; ++way)
        setup.scripts[0].push_back({100 * way, read(way * set_stride)});
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(requests_below(outcome),
                ElementsAre(read(set_stride), read(2 * set_stride), write(0, 64), write(96, 32)));
    EXPECT_EQ(outcome.counters.write_backs, 1U);
    EXPECT_EQ(outcome.counters.bytes_to_below, 96U);
}

TEST(Cache, DropsCleanLinesWithoutAWord) {
    CacheSetup setup{.config = small_cache(), .scripts = {{}}};
    for (std::uint64_t way = 0; way < 3; ++way)
        setup.scripts[0].push_back({200 * way, read(way * set_stride)});
    const CacheOutcome outcome = run(setup);
    EXPECT_EQ(outcome.counters.evictions, 1U);
    EXPECT_EQ(outcome.counters.bytes_to_below, 0U);
}

TEST(Cache, WritesBackWhenNothingElseMoves) {
    CacheSetup setup{.config = small_cache(), .scripts = {{}}};
    for (std::uint64_t way = 0; way < 3; ++way) setup.scripts[0].push_back({way, write(way * set_stride)});
    EXPECT_THAT(requests_below(run(setup)), ElementsAre(write(0)));
}

TEST(Cache, AsksForALineOnlyAfterItWasWrittenBack) {
    // Line 0 leaves, in two writes, when line 2 * set_stride comes, and is wanted again in the next cycle.
    const CacheSetup setup{.config = small_cache(),
                           .scripts = {{{0, write(0)},
                                        {1, write(64)},
                                        {100, read(set_stride)},
                                        {200, read(2 * set_stride)},
                                        {201, read(0)}}}};
    const CacheOutcome outcome = run(setup);
    EXPECT_THAT(requests_below(outcome),
                ElementsAre(read(set_stride), read(2 * set_stride), write(0), write(64), read(0)));
    EXPECT_EQ(outcome.counters.write_back_stall_cycles, 1U);
}

TEST(Cache, HoldsItsInputBackWhileItsClientTakesNothing) {
    constexpr Cycle opening = 1000;
    CacheSetup setup{.config = small_cache(), .scripts = {{{0, write(0)}}}, .channel_depth = 2};
    setup.config.banks = 1;
    setup.is_sink_open = [](Cycle now) { return now >= opening; };
    for (std::uint32_t i = 0; i < 40; ++i) setup.scripts[0].push_back({10, read(0, 32, i)});
    const CacheOutcome outcome = run(setup);
    const std::size_t held = setup.channel_depth            // requests waiting
                             + setup.config.latency_cycles  // in the pipeline
                             + setup.channel_depth;         // replies waiting
    EXPECT_LT(outcome.pushed[0].at(held), opening);         // request 0 is the write
    EXPECT_GE(outcome.pushed[0].at(held + 1), opening);
    for (std::uint32_t i = 0; i < 40; ++i) EXPECT_EQ(outcome.received[0].at(i).item.tag, i);
    EXPECT_GT(outcome.account.blocked, 900U);
}

TEST(Cache, ServesItsInputsInTurn) {
    CacheSetup setup{.config = small_cache(), .scripts = {{{0, write(0)}}, {}, {}}, .reply_count = 3};
    for (std::uint8_t input = 0; input < 3; ++input) {
        for (std::uint32_t i = 0; i < 30; ++i) {
            setup.scripts[input].push_back({100, read(0, 32, i, input)});
        }
    }
    const CacheOutcome outcome = run(setup);
    for (std::size_t i = 0; i < 3; ++i) {
        // One bank, three inputs: each gets every third cycle.
        const std::vector<Cycle> cycles = reply_cycles(outcome, i);
        EXPECT_EQ(cycles.back() - cycles.front(), 29U * 3U);
    }
}

TEST(Cache, ReportsAReadThatWasNotAnswered) {
    sim::start_fresh_kernel();
    CacheRig rig({.config = small_cache(), .scripts = {{{0, read(0)}}}});
    rig.run([&] { return rig.cache().counters().misses == 1; });
    EXPECT_THROW(rig.cache().check_drained(), std::logic_error);
}

}  // namespace
}  // namespace rtu::test
