#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mock_units.hpp"
#include "sim/dram.hpp"
#include "sim/kernel.hpp"

namespace rtu::test {
namespace {

using sim::ClockMode;
using sim::MemoryReply;
using sim::MemoryRequest;
using testing::ElementsAre;
using Script = std::vector<Stamped<MemoryRequest>>;

constexpr std::uint64_t block_bytes = 128;
constexpr std::uint32_t hop_cycles = 1;  // a channel: pushed in t, seen in t + 1

// One channel of two banks with rows of four blocks.
sim::Config::Dram small_dram() {
    return {.channels = 1,
            .banks = 2,
            .row_bytes = 512,
            .queue_entries = 8,
            .bytes_per_cycle = 16,
            .t_rcd_cycles = 11,
            .t_rp_cycles = 13,
            .t_cas_cycles = 7,
            .latency_cycles = 30};
}
constexpr std::uint64_t bank_stride = 512;
constexpr std::uint64_t row_stride = 2 * bank_stride;  // next row of the same bank

struct DramSetup {
    sim::Config::Dram config{};
    Script script{};
    std::size_t channel_depth = 16;
    std::function<bool(Cycle)> is_sink_open{};
    ClockMode mode = ClockMode::Fast;
    bool is_reversed = false;
};

struct DramOutcome {
    Cycle cycles = 0;
    std::vector<Cycle> pushed;
    std::vector<Stamped<MemoryReply>> received;
    sim::DramCounters counters;
    sim::CycleAccount account;
    friend bool operator==(const DramOutcome&, const DramOutcome&) = default;
};

class DramRig {
  public:
    explicit DramRig(const DramSetup& setup) : setup_(setup), clock_("clock", setup.mode, 100'000) {
        std::vector<std::function<void()>> steps{[this] { build_source(); }, [this] { build_dram(); },
                                                 [this] { build_sink(); }};
        if (setup.is_reversed) std::ranges::reverse(steps);
        for (const auto& build : steps) build();
    }
    DramOutcome run() {
        DramOutcome outcome;
        outcome.cycles = clock_.run([this] {
            return source_->is_done() && requests_.size() == 0 && replies_.size() == 0 &&
                   dram_->next_event(0) == no_cycle;
        });
        dram_->check_drained();
        outcome.pushed = source_->pushed();
        outcome.received = sink_->received();
        outcome.counters = dram_->counters();
        outcome.account = dram_->cycle_account();
        return outcome;
    }

  private:
    void build_source() {
        source_ = std::make_unique<MockSource<MemoryRequest>>("source", clock_, setup_.script);
        source_->out(requests_);
    }
    void build_dram() {
        dram_ = std::make_unique<sim::Dram>("dram", clock_, setup_.config, std::uint32_t(block_bytes));
        dram_->requests_in(requests_);
        dram_->replies_out(replies_);
    }
    void build_sink() {
        sink_ = std::make_unique<MockSink<MemoryReply>>("sink", clock_, setup_.is_sink_open);
        sink_->in(replies_);
    }

    DramSetup setup_;
    ClockDomain clock_;
    Fifo<MemoryRequest> requests_{"requests", setup_.channel_depth, clock_};
    Fifo<MemoryReply> replies_{"replies", setup_.channel_depth, clock_};
    std::unique_ptr<MockSource<MemoryRequest>> source_;
    std::unique_ptr<sim::Dram> dram_;
    std::unique_ptr<MockSink<MemoryReply>> sink_;
};

DramOutcome run(const DramSetup& setup) {
    sim::start_fresh_kernel();
    return DramRig(setup).run();
}

MemoryRequest read(std::uint64_t address, std::uint32_t size_bytes = std::uint32_t(block_bytes),
                   std::uint32_t tag = 0) {
    return {address, size_bytes, tag, 0, false};
}
MemoryRequest write(std::uint64_t address, std::uint32_t size_bytes = std::uint32_t(block_bytes)) {
    return {address, size_bytes, 0, 0, true};
}

std::vector<Cycle> reply_cycles(const DramOutcome& outcome) {
    std::vector<Cycle> cycles;
    for (const auto& reply : outcome.received) cycles.push_back(reply.cycle);
    return cycles;
}
std::vector<std::uint32_t> reply_tags(const DramOutcome& outcome) {
    std::vector<std::uint32_t> tags;
    for (const auto& reply : outcome.received) tags.push_back(reply.item.tag);
    return tags;
}

// From the push of a read to the reception of its reply, with the row open.
Cycle row_hit_cycles(const sim::Config::Dram& config, std::uint32_t size_bytes = std::uint32_t(block_bytes)) {
    const Cycle burst = (size_bytes + config.bytes_per_cycle - 1) / config.bytes_per_cycle;
    return hop_cycles + config.t_cas_cycles + burst + config.latency_cycles + hop_cycles;
}

TEST(Dram, AnswersAfterItsClosedFormLatencies) {
    const DramSetup setup{.config = small_dram(),
                          .script = {{0, read(0)}, {500, read(128)}, {1000, read(row_stride)}}};
    const DramOutcome outcome = run(setup);
    const Cycle hit = row_hit_cycles(setup.config);
    const Cycle closed = hit + setup.config.t_rcd_cycles;
    const Cycle conflict = closed + setup.config.t_rp_cycles;
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(closed, 500 + hit, 1000 + conflict));
    EXPECT_EQ(outcome.counters.row_misses, 1U);
    EXPECT_EQ(outcome.counters.row_hits, 1U);
    EXPECT_EQ(outcome.counters.row_conflicts, 1U);
}

TEST(Dram, OccupiesTheBusForWholeCycles) {
    DramSetup setup{.config = small_dram(), .script = {{0, read(0)}, {500, read(0, 33)}}};
    const DramOutcome outcome = run(setup);
    EXPECT_EQ(outcome.received.at(1).cycle, 500 + row_hit_cycles(setup.config, 33));
    EXPECT_EQ(outcome.counters.bus_busy_cycles, 8U + 3U);
}

TEST(Dram, StreamsRowHitsAtTheFullBandwidthOfItsBus) {
    DramSetup setup{.config = small_dram(), .script = {{0, read(0)}}};
    constexpr std::uint32_t count = 64;
    for (std::uint32_t i = 0; i < count; ++i) setup.script.push_back({500, read(i % 4 * block_bytes)});
    const std::vector<Cycle> cycles = reply_cycles(run(setup));
    const Cycle burst = block_bytes / setup.config.bytes_per_cycle;
    for (std::uint32_t k = 0; k < count; ++k) {
        EXPECT_EQ(cycles.at(1 + k), 500 + row_hit_cycles(setup.config) + k * burst);
    }
}

TEST(Dram, StreamsThroughItsChannelsSideBySide) {
    DramSetup setup{.config = small_dram()};
    setup.config.channels = 4;
    setup.config.row_bytes = 2048;
    for (std::uint32_t i = 0; i < 32; ++i) setup.script.push_back({0, read(i * block_bytes)});
    const DramOutcome outcome = run(setup);
    const Cycle burst = block_bytes / setup.config.bytes_per_cycle;
    const Cycle closed = row_hit_cycles(setup.config) + setup.config.t_rcd_cycles;
    // The channel of requests holds 16; the last ones still arrive before their bus is free.
    EXPECT_EQ(outcome.received.back().cycle, closed + 7 * burst);
    EXPECT_EQ(outcome.counters.row_misses, 4U);
}

TEST(Dram, OpensARowBehindTheDataOfAnotherBank) {
    DramSetup setup{.config = small_dram(), .script = {{0, read(0)}, {0, read(128)}, {0, read(bank_stride)}}};
    const DramOutcome outcome = run(setup);
    const Cycle burst = block_bytes / setup.config.bytes_per_cycle;
    const Cycle first = row_hit_cycles(setup.config) + setup.config.t_rcd_cycles;
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(first, first + burst, first + 2 * burst));
}

TEST(Dram, IssuesACommandEveryCycle) {
    const DramSetup setup{.config = small_dram(), .script = {{0, read(0, 16)}, {0, read(bank_stride, 16)}}};
    const Cycle first = row_hit_cycles(setup.config, 16) + setup.config.t_rcd_cycles;
    EXPECT_THAT(reply_cycles(run(setup)), ElementsAre(first, first + 1));
}

TEST(Dram, ClosesARowAfterItsBurst) {
    const DramSetup setup{.config = small_dram(), .script = {{0, read(0)}, {0, read(row_stride)}}};
    const Cycle hit = row_hit_cycles(setup.config);
    const Cycle first_column = setup.config.t_rcd_cycles;
    const Cycle burst = block_bytes / setup.config.bytes_per_cycle;
    const Cycle reopened = first_column + burst + setup.config.t_rp_cycles + setup.config.t_rcd_cycles;
    EXPECT_THAT(reply_cycles(run(setup)), ElementsAre(first_column + hit, reopened + hit));
}

TEST(Dram, ServesAYoungerRowHitFirst) {
    // Request 1 wants another row of the bank that request 0 opened; request 2 wants the open one.
    const DramSetup setup{
        .config = small_dram(),
        .script = {{0, read(0, 128, 0)}, {0, read(row_stride, 128, 1)}, {1, read(128, 128, 2)}}};
    const DramOutcome outcome = run(setup);
    EXPECT_THAT(reply_tags(outcome), ElementsAre(0, 2, 1));
    EXPECT_EQ(outcome.counters.row_hits, 1U);
    EXPECT_EQ(outcome.counters.row_conflicts, 1U);
}

TEST(Dram, ServesEqualsInTheirOrder) {
    DramSetup setup{.config = small_dram(), .script = {{0, read(0)}}};
    for (std::uint32_t i = 1; i < 6; ++i) setup.script.push_back({0, read(i % 4 * block_bytes, 128, i)});
    EXPECT_THAT(reply_tags(run(setup)), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Dram, SpendsBandwidthOnWritesButDoesNotAnswerThem) {
    const DramSetup setup{.config = small_dram(),
                          .script = {{0, read(0)}, {500, write(128)}, {500, read(256, 128, 1)}}};
    const DramOutcome outcome = run(setup);
    ASSERT_EQ(outcome.received.size(), 2U);
    const Cycle burst = block_bytes / setup.config.bytes_per_cycle;
    EXPECT_EQ(outcome.received.at(1).cycle, 500 + row_hit_cycles(setup.config) + burst);
    EXPECT_EQ(outcome.counters.write_bytes, 128U);
}

TEST(Dram, HoldsItsInputBackWhileAQueueIsFull) {
    DramSetup setup{.config = small_dram(), .channel_depth = 2};
    for (std::uint32_t i = 0; i < 20; ++i) setup.script.push_back({0, read(0, 128, i)});
    const DramOutcome outcome = run(setup);
    // The first one leaves its queue when its row is open.
    const std::size_t held = setup.config.queue_entries + setup.channel_depth;
    EXPECT_LT(outcome.pushed.at(held - 1), setup.config.t_rcd_cycles);
    EXPECT_GT(outcome.pushed.at(held), setup.config.t_rcd_cycles);
    EXPECT_GT(outcome.counters.queue_full_cycles, 0U);
    EXPECT_EQ(outcome.received.size(), 20U);
}

TEST(Dram, LosesNothingWhileItsClientTakesNothing) {
    constexpr Cycle opening = 1000;
    DramSetup setup{.config = small_dram(), .channel_depth = 2};
    setup.config.queue_entries = 2;
    setup.config.latency_cycles = 1;
    setup.is_sink_open = [](Cycle now) { return now >= opening; };
    for (std::uint32_t i = 0; i < 40; ++i) setup.script.push_back({0, read(i % 4 * block_bytes, 16, i)});
    const DramOutcome outcome = run(setup);
    ASSERT_EQ(outcome.received.size(), 40U);
    for (std::uint32_t i = 0; i < 40; ++i) EXPECT_EQ(outcome.received[i].item.tag, i);
    EXPECT_GE(outcome.pushed.back(), opening);
    EXPECT_GT(outcome.counters.reply_stall_cycles, 900U);
}

DramSetup random_traffic(std::uint32_t seed) {
    DramSetup setup{.config = small_dram(), .channel_depth = 4};
    setup.config.channels = 2;
    std::uint32_t state = seed;
    const auto next = [&state] { return state = state * 1664525U + 1013904223U, state >> 8; };
    Cycle when = 0;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        if (next() % 16 == 0) when += next() % 200;
        const std::uint64_t address = next() % 256 * block_bytes;
        setup.script.push_back(
            {when, next() % 5 == 0 ? write(address) : read(address, 32 * (1 + next() % 4), i)});
    }
    return setup;
}

TEST(Dram, AnswersEveryReadExactlyOnce) {
    DramSetup setup = random_traffic(1);
    setup.is_sink_open = [](Cycle now) { return now % 3 != 0; };
    std::vector<std::uint32_t> tags = reply_tags(run(setup));
    std::ranges::sort(tags);
    std::vector<std::uint32_t> expected;
    for (const auto& request : setup.script) {
        if (!request.item.is_write) expected.push_back(request.item.tag);
    }
    EXPECT_EQ(tags, expected);
}

TEST(Dram, DoesNotDependOnTheOrderOfUnitsOrTheClockMode) {
    DramSetup setup = random_traffic(2);
    const DramOutcome forward = run(setup);
    EXPECT_EQ(forward.account.total(), forward.cycles);
    setup.is_reversed = true;
    EXPECT_EQ(run(setup), forward);
    setup.mode = ClockMode::Verify;
    EXPECT_EQ(run(setup), forward);
}

}  // namespace
}  // namespace rtu::test
