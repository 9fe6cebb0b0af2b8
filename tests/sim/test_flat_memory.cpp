#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mock_units.hpp"
#include "sim/flat_memory.hpp"
#include "sim/kernel.hpp"

namespace rtu::test {
namespace {

using sim::ClockMode;
using sim::MemoryReply;
using sim::MemoryRequest;
using testing::Each;
using testing::ElementsAre;
using Script = std::vector<Stamped<MemoryRequest>>;

constexpr std::uint32_t hop_cycles = 1;  // a channel: pushed in t, seen in t + 1

struct FlatSetup {
    sim::Config::Memory config{.model = sim::MemoryModel::Flat, .latency_cycles = 20, .bytes_per_cycle = 16};
    std::vector<Script> scripts{};  ///< [client]
    std::size_t channel_depth = 16;
    std::function<bool(Cycle)> is_sink_open{};
    ClockMode mode = ClockMode::Fast;
    bool is_reversed = false;
};

struct FlatOutcome {
    Cycle cycles = 0;
    std::vector<std::vector<Cycle>> pushed;                   // [client][request]
    std::vector<std::vector<Stamped<MemoryReply>>> received;  // [client]
    sim::FlatMemoryCounters counters;
    sim::CycleAccount account;
    friend bool operator==(const FlatOutcome&, const FlatOutcome&) = default;
};

// A flat memory between a source and a sink for each client.
class FlatRig {
  public:
    explicit FlatRig(const FlatSetup& setup) : setup_(setup), clock_("clock", setup.mode, 100'000) {
        for (std::size_t i = 0; i < setup.scripts.size(); ++i) {
            requests_.push_back(channel<MemoryRequest>("requests", i));
            replies_.push_back(channel<MemoryReply>("replies", i));
        }
        if (setup.is_reversed) build_ends();
        memory_ = std::make_unique<sim::FlatMemory>("memory", clock_, setup_.config, requests_.size());
        if (!setup.is_reversed) build_ends();
        for (std::size_t i = 0; i < requests_.size(); ++i) {
            memory_->requests_in[i](*requests_[i]);
            memory_->replies_out[i](*replies_[i]);
        }
    }
    FlatOutcome run() {
        FlatOutcome outcome;
        outcome.cycles = clock_.run([this] { return has_finished(); });
        memory_->check_drained();
        for (const auto& source : sources_) outcome.pushed.push_back(source->pushed());
        for (const auto& sink : sinks_) outcome.received.push_back(sink->received());
        outcome.counters = memory_->counters();
        outcome.account = memory_->cycle_account();
        return outcome;
    }

  private:
    static std::string numbered(const char* name, std::size_t number) {
        return fmt::format("{}{}", name, number);
    }
    template <class T>
    std::unique_ptr<Fifo<T>> channel(const char* name, std::size_t number) {
        return std::make_unique<Fifo<T>>(numbered(name, number).c_str(), setup_.channel_depth, clock_);
    }
    void build_ends() {
        for (std::size_t i = 0; i < requests_.size(); ++i) {
            sources_.push_back(std::make_unique<MockSource<MemoryRequest>>(numbered("source", i).c_str(),
                                                                           clock_, setup_.scripts[i]));
            sources_[i]->out(*requests_[i]);
            sinks_.push_back(std::make_unique<MockSink<MemoryReply>>(numbered("sink", i).c_str(), clock_,
                                                                     setup_.is_sink_open));
            sinks_[i]->in(*replies_[i]);
        }
    }
    [[nodiscard]] bool has_finished() const {
        for (std::size_t i = 0; i < requests_.size(); ++i) {
            if (!sources_[i]->is_done() || requests_[i]->size() + replies_[i]->size() != 0) return false;
        }
        return memory_->next_event(0) == no_cycle;
    }

    FlatSetup setup_;
    ClockDomain clock_;
    std::vector<std::unique_ptr<Fifo<MemoryRequest>>> requests_;
    std::vector<std::unique_ptr<Fifo<MemoryReply>>> replies_;
    std::vector<std::unique_ptr<MockSource<MemoryRequest>>> sources_;
    std::vector<std::unique_ptr<MockSink<MemoryReply>>> sinks_;
    std::unique_ptr<sim::FlatMemory> memory_;
};

FlatOutcome run(const FlatSetup& setup) {
    sim::start_fresh_kernel();
    return FlatRig(setup).run();
}

MemoryRequest read(std::uint32_t size_bytes, std::uint32_t tag = 0, std::uint8_t source = 0) {
    return {std::uint64_t(tag) * 128, size_bytes, tag, source, false};
}
MemoryRequest write(std::uint32_t size_bytes) { return {0, size_bytes, 0, 0, true}; }

std::vector<Cycle> reply_cycles(const FlatOutcome& outcome, std::size_t client = 0) {
    std::vector<Cycle> cycles;
    for (const auto& reply : outcome.received[client]) cycles.push_back(reply.cycle);
    return cycles;
}

// From the push of a read to the reception of its reply.
Cycle unloaded_cycles(const sim::Config::Memory& config, std::uint32_t size_bytes) {
    const Cycle burst = (size_bytes + config.bytes_per_cycle - 1) / config.bytes_per_cycle;
    return hop_cycles + burst + config.latency_cycles + hop_cycles;
}

TEST(FlatMemory, AnswersAfterItsClosedFormLatency) {
    for (const std::uint32_t bytes_per_cycle : {1U, 16U, 33U, 1024U}) {
        FlatSetup setup{.scripts = {{{0, read(128)}, {500, read(33)}, {1000, read(32)}}}};
        setup.config.bytes_per_cycle = bytes_per_cycle;
        EXPECT_THAT(reply_cycles(run(setup)),
                    ElementsAre(unloaded_cycles(setup.config, 128), 500 + unloaded_cycles(setup.config, 33),
                                1000 + unloaded_cycles(setup.config, 32)));
    }
}

TEST(FlatMemory, StreamsAtItsBandwidthInOrder) {
    FlatSetup setup{.scripts = {{}}};
    for (std::uint32_t i = 0; i < 64; ++i) setup.scripts[0].push_back({0, read(128, i)});
    const FlatOutcome outcome = run(setup);
    const Cycle first = unloaded_cycles(setup.config, 128);
    for (std::uint32_t i = 0; i < 64; ++i) {
        EXPECT_EQ(outcome.received[0].at(i).cycle, first + i * 8);
        EXPECT_EQ(outcome.received[0].at(i).item.tag, i);
    }
    EXPECT_EQ(outcome.counters.bus_busy_cycles, 64U * 8U);
}

TEST(FlatMemory, SpendsBandwidthOnWritesButDoesNotAnswerThem) {
    const FlatSetup setup{.scripts = {{{0, write(128)}, {0, read(32)}}}};
    const FlatOutcome outcome = run(setup);
    EXPECT_THAT(reply_cycles(outcome), ElementsAre(8 + unloaded_cycles(setup.config, 32)));
    EXPECT_EQ(outcome.counters.write_bytes, 128U);
    EXPECT_EQ(outcome.counters.writes, 1U);
}

TEST(FlatMemory, HoldsItsInputBackWhileTheBusIsBusy) {
    FlatSetup setup{.scripts = {{}}, .channel_depth = 2};
    for (std::uint32_t i = 0; i < 8; ++i) setup.scripts[0].push_back({0, read(128, i)});
    const std::vector<Cycle> pushed = run(setup).pushed[0];
    // Taken in cycles 1, 9, 17, ...; the place is free in the next.
    for (std::size_t i = 2; i < pushed.size(); ++i) EXPECT_EQ(pushed[i], 2 + 8 * (i - 2));
}

// What a full channel holds back is bounded, and nothing is lost or reordered.
TEST(FlatMemory, StopsReadingBehindRepliesThatCannotLeave) {
    FlatSetup setup{.scripts = {{}}, .channel_depth = 2, .is_sink_open = [](Cycle now) { return now > 900; }};
    for (std::uint32_t i = 0; i < 100; ++i) setup.scripts[0].push_back({0, read(16, i)});
    const FlatOutcome outcome = run(setup);
    const std::size_t held = 2 + (setup.config.latency_cycles + 2) + 2;  // replies, under way, requests
    EXPECT_LT(outcome.pushed[0].at(held - 1), 200U);
    EXPECT_GT(outcome.pushed[0].at(held), 900U);
    EXPECT_GT(outcome.counters.reply_stall_cycles, 800U);
    for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(outcome.received[0].at(i).item.tag, i);
}

TEST(FlatMemory, ServesItsClientsInTurnAndRepliesToTheOneThatAsked) {
    FlatSetup setup{.scripts = {{}, {}, {}}};
    for (std::uint8_t client = 0; client < 3; ++client) {
        for (std::uint32_t i = 0; i < 16; ++i) setup.scripts[client].push_back({0, read(16, i, client)});
    }
    const FlatOutcome outcome = run(setup);
    for (std::size_t client = 0; client < 3; ++client) {
        const std::vector<Cycle> cycles = reply_cycles(outcome, client);
        ASSERT_EQ(cycles.size(), 16U);
        for (std::size_t i = 1; i < cycles.size(); ++i) EXPECT_EQ(cycles[i] - cycles[i - 1], 3U);
    }
}

TEST(FlatMemory, DoesNotDependOnTheOrderOfUnitsOrTheClockMode) {
    FlatSetup setup{
        .scripts = {{}, {}}, .channel_depth = 3, .is_sink_open = [](Cycle now) { return now % 7 < 3; }};
    for (std::uint8_t client = 0; client < 2; ++client) {
        for (std::uint32_t i = 0; i < 200; ++i) {
            const std::uint32_t bytes = 32 * (1 + (i * 7 + client) % 4);
            setup.scripts[client].push_back(
                {Cycle(i) * 8, i % 5 == 0 ? write(bytes) : read(bytes, i, client)});
        }
    }
    const FlatOutcome forward = run(setup);
    EXPECT_EQ(forward.account.total(), forward.cycles);
    setup.is_reversed = true;
    EXPECT_EQ(run(setup), forward);
    setup.mode = ClockMode::Verify;
    EXPECT_EQ(run(setup), forward);
}

}  // namespace
}  // namespace rtu::test
