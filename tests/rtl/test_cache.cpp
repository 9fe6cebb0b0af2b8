#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cache_traffic.hpp"
#include "vectors.hpp"

namespace rtu::test {
namespace {

using sim::CacheCounters;

std::string to_string(const CacheEvent& event) {
    return fmt::format("cycle {}: {} of source {}, tag {}", event.cycle,
                       event.kind == CacheEvent::Kind::Request ? "request" : "reply", event.source,
                       event.tag);
}

// Runs both and compares every cycle and counter; the counters are the result.
CacheCounters compare(const CacheCase& test_case) {
    const CacheRun simulated = run_simulated(test_case);
    const CacheRun verilated = run_verilated(test_case);
    const std::size_t count = std::min(simulated.events.size(), verilated.events.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (simulated.events[i] == verilated.events[i]) continue;
        ADD_FAILURE() << "event " << i << ": expected " << to_string(simulated.events[i]) << ", got "
                      << to_string(verilated.events[i]);
        break;
    }
    EXPECT_EQ(verilated.events.size(), simulated.events.size());
    for (const auto& row : sim::cache_counter_rows) {
        EXPECT_EQ(verilated.counters.*row.member, simulated.counters.*row.member) << row.name;
    }
    EXPECT_EQ(verilated.memory.reads, simulated.memory.reads);
    EXPECT_EQ(verilated.memory.writes, simulated.memory.writes);
    EXPECT_EQ(verilated.memory.read_bytes, simulated.memory.read_bytes);
    EXPECT_EQ(verilated.memory.write_bytes, simulated.memory.write_bytes);
    return simulated.counters;
}

sim::Config::Cache cache_of(std::uint32_t sets, std::uint32_t ways, std::uint32_t banks, std::uint32_t mshrs,
                            std::uint32_t targets, std::uint32_t latency_cycles) {
    return {sets * ways * 128, 128, 32, ways, banks, mshrs, targets, latency_cycles};
}

PlannedRequest read(std::uint64_t address, std::uint32_t size_bytes = 32, std::uint32_t gap_cycles = 0,
                    std::uint8_t source = 0) {
    return {gap_cycles, address, size_bytes, source, false};
}
PlannedRequest write(std::uint64_t address, std::uint32_t gap_cycles = 0) {
    return {gap_cycles, address, sector_bytes, 2, true};
}

// What an RTU might ask for: nodes, leaves, and stack blocks that are written and read, over `lines` lines.
struct Shape {
    std::uint32_t count = 4'000;
    std::uint32_t lines = 64;
    std::uint32_t node_bytes = 128;
    std::uint32_t write_percent = 20;
    std::uint32_t idle_percent = 10;  ///< of the requests come some cycles after the one before
};
std::vector<PlannedRequest> random_plan(RandomBits& random, const Shape& shape) {
    std::vector<PlannedRequest> plan;
    const std::uint32_t blocks = shape.lines * 2;
    while (plan.size() < shape.count) {
        PlannedRequest request;
        request.gap_cycles = random.below(100) < shape.idle_percent ? random.below(40) : 0;
        request.source = std::uint8_t(random.below(3));
        request.is_write = random.below(100) < shape.write_percent;
        if (request.is_write || request.source == 2) {
            request.source = 2;
            request.address = std::uint64_t(random.below(shape.lines * 4)) * sector_bytes;
        } else {
            request.size_bytes = request.source == 0 ? shape.node_bytes : 64;
            request.address = std::uint64_t(random.below(blocks)) * 64;
        }
        plan.push_back(request);
    }
    return plan;
}

TEST(CacheRtl, MissesThenHitsWithTheClosedFormLatencies) {
    CacheCase test_case{
        .plan = {read(0, 128), read(0, 128, 500), read(64, 64, 500, 1), read(32, 32, 500, 2)}};
    const CacheRun run = run_verilated(test_case);
    const Cycle hit = 1 + test_case.cache.latency_cycles + 1;  // channel, latency, channel
    const Cycle below = 2 + 4 + test_case.memory.latency_cycles;
    ASSERT_EQ(run.events.size(), 8U);
    EXPECT_EQ(run.events[1].cycle, hit + below);
    for (std::size_t i : {3U, 5U, 7U}) EXPECT_EQ(run.events[i].cycle - run.events[i - 1].cycle, hit);
    EXPECT_EQ(run.counters.hits, 3U);
    (void)compare(test_case);
}

TEST(CacheRtl, EqualsTheSimulatorOnRandomTraffic) {
    constexpr std::uint64_t by_default = 960'000, vectors_a_case = 40'000;
    RandomBits random(81);
    // A case takes about as long as 40,000 vectors of the other units.
    const std::uint64_t count = vector_count(by_default) / vectors_a_case;
    CacheCounters sum;
    for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
        CacheCase test_case;
        const std::uint32_t banks = 1U << random.below(3);
        const std::uint32_t sets = std::max(banks, 1U << random.below(6)), ways = 1 + random.below(16);
        // Half of them lack MSHRs and targets, some bandwidth.
        const bool is_scarce = random.one_in(2);
        test_case.cache =
            cache_of(sets, ways, banks, std::min(sets * ways, 1 + random.below(is_scarce ? 4 : 64)),
                     1 + random.below(is_scarce ? 3 : 16), 1 + random.below(32));
        test_case.memory.latency_cycles = 1 + random.below(random.one_in(4) ? 4 : 200);
        test_case.memory.bytes_per_cycle = random.one_in(4) ? 2 : 4U << random.below(6);
        const Shape shape{.count = 600,
                          .lines = 1 + random.below(2 * sets * ways),
                          .node_bytes = 64 * (1 + random.below(4)),
                          .write_percent = random.below(60),
                          .idle_percent = random.below(101)};
        test_case.plan = random_plan(random, shape);
        const std::uint32_t one_in = random.below(5);
        if (one_in > 1) {
            test_case.takes = [one_in](std::uint8_t source, Cycle now) {
                return (now / 64 + source) % one_in == 0;
            };
        }
        SCOPED_TRACE(
            fmt::format("case {}: {} sets, {} ways, {} banks, {} MSHRs, {} targets, latency {}, memory {} "
                        "cycles, {} bytes a cycle",
                        i, sets, ways, banks, test_case.cache.mshrs, test_case.cache.targets_per_mshr,
                        test_case.cache.latency_cycles, test_case.memory.latency_cycles,
                        test_case.memory.bytes_per_cycle));
        sum = sim::sum(sum, compare(test_case), sim::cache_counter_rows);
    }
    if (count < by_default / vectors_a_case) return;
    // The traffic reached every corner.
    for (const auto& row : sim::cache_counter_rows) EXPECT_GT(sum.*row.member, 0U) << row.name;
}

// A cache of `lines` lines, one way: two lines that share their set throw each other out.
TEST(CacheRtl, ThrowsOutAConflictingLine) {
    CacheCase test_case{.cache = cache_of(8, 1, 4, 8, 4, 5)};
    for (std::uint32_t i = 0; i < 20; ++i) test_case.plan.push_back(read(i % 2 * 8 * 128, 128, 300));
    const CacheCounters counters = compare(test_case);
    EXPECT_EQ(counters.misses, 20U);
    EXPECT_EQ(counters.evictions, 19U);
    test_case.cache.ways = 2;  // of half as many sets
    EXPECT_EQ(compare(test_case).misses, 2U);
}

// Ways that are used in turn leave in turn; one that is used again stays.
TEST(CacheRtl, ThrowsOutTheLeastRecentlyUsedWay) {
    CacheCase test_case{.cache = cache_of(1, 4, 1, 4, 4, 5)};
    for (const std::uint32_t line : {0, 1, 2, 3, 0, 4, 0, 5, 0, 1, 0, 6, 4}) {
        test_case.plan.push_back(read(line * 128U, 128, 300));
    }
    EXPECT_EQ(compare(test_case).hits, 4U);
}

TEST(CacheRtl, WaitsForAnMshrATargetAWayAndTheQueueBelow) {
    CacheCase test_case{.cache = cache_of(8, 4, 4, 2, 16, 20)};
    for (std::uint32_t i = 0; i < 16; ++i) test_case.plan.push_back(read(i * 128, 128));
    EXPECT_GT(compare(test_case).mshr_full_cycles, 50U);

    test_case = {.cache = cache_of(8, 4, 4, 8, 3, 20)};
    for (std::uint32_t i = 0; i < 16; ++i) test_case.plan.push_back(read(i % 4 * 32, 32, 0, 2));
    EXPECT_GT(compare(test_case).target_full_cycles, 50U);

    test_case = {.cache = cache_of(8, 2, 2, 16, 16, 20)};
    for (std::uint32_t i = 0; i < 16; ++i) test_case.plan.push_back(read(i * 8 * 128, 128));
    EXPECT_GT(compare(test_case).set_full_cycles, 50U);

    test_case = {.cache = cache_of(8, 8, 4, 64, 16, 20)};
    test_case.memory.bytes_per_cycle = 1;
    for (std::uint32_t i = 0; i < 32; ++i) test_case.plan.push_back(read(i * 128, 128));
    EXPECT_GT(compare(test_case).below_full_cycles, 50U);
}

// Of a line with dirty sectors 0 and 2: two runs. Lines leave faster than memory takes them, and the last
// ones are read back while they are on their way.
TEST(CacheRtl, WritesDirtySectorsBackAndReadsThemAgain) {
    CacheCase test_case{.cache = cache_of(1, 1, 1, 1, 4, 3)};
    test_case.memory.bytes_per_cycle = 1;
    for (std::uint64_t line = 0; line < 20 * 128; line += 128) {
        test_case.plan.push_back(write(line));
        test_case.plan.push_back(write(line + 64));
    }
    for (std::uint64_t line = 18 * 128; line > 0; line -= 128) test_case.plan.push_back(read(line, 128));
    const CacheCounters counters = compare(test_case);
    EXPECT_EQ(counters.write_backs, 20U);
    EXPECT_EQ(counters.bytes_to_below, 20U * 64U);
    EXPECT_GT(counters.write_back_stall_cycles, 50U);
}

TEST(CacheRtl, HoldsEverythingBackBehindRepliesThatNobodyTakes) {
    CacheCase test_case{.cache = cache_of(8, 4, 4, 16, 16, 2)};
    test_case.takes = [](std::uint8_t source, Cycle now) { return source != 0 || now > 2'000; };
    for (std::uint32_t i = 0; i < 60; ++i) test_case.plan.push_back(read(i % 8 * 128, 128));
    for (std::uint32_t i = 0; i < 60; ++i) test_case.plan.push_back(read(i % 8 * 128, 64, 0, 1));
    const CacheCounters counters = compare(test_case);
    EXPECT_GT(counters.reply_stall_cycles, 1'500U);
    EXPECT_GT(counters.pipeline_full_cycles, 1'500U);
}

TEST(CacheRtl, ServesALineThreeTimesAsLongAsItself) {
    CacheCase test_case{.cache = cache_of(1, 1, 1, 1, 1, 1)};  // the smallest that there is
    for (std::uint32_t i = 0; i < 40; ++i) test_case.plan.push_back(read(64 * (i % 5), 256, i % 3));
    EXPECT_GT(compare(test_case).misses, 80U);
}

}  // namespace
}  // namespace rtu::test
