#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

#include "sim/clock_domain.hpp"
#include "sim/fifo.hpp"
#include "sim/kernel.hpp"
#include "sim/pipeline.hpp"

namespace rtu::sim {
namespace {

TEST(Pipeline, IsNotReadyOneCycleEarly) {
    Pipeline<int> pipeline(5, 8);
    pipeline.push(10, 42);
    EXPECT_FALSE(pipeline.is_ready(14));
    EXPECT_TRUE(pipeline.is_ready(15));
    EXPECT_EQ(pipeline.ready_at(), 15U);
    EXPECT_EQ(pipeline.pop(), 42);
    EXPECT_EQ(pipeline.ready_at(), no_cycle);
}

TEST(Pipeline, KeepsOrderAndBound) {
    Pipeline<int> pipeline(2, 3);
    for (int i = 0; i < 3; ++i) pipeline.push(Cycle(i), i);
    EXPECT_TRUE(pipeline.is_full());
    for (int i = 0; i < 3; ++i) EXPECT_EQ(pipeline.pop(), i);
    EXPECT_TRUE(pipeline.is_empty());
}

TEST(Fifo, ShowsAPushInTheNextCycle) {
    ClockDomain domain("domain", ClockMode::Fast, 100);
    Fifo<int> fifo("fifo", 2, domain);
    fifo.push(7, 1);
    EXPECT_FALSE(fifo.can_pop(7));
    EXPECT_TRUE(fifo.can_pop(8));
    EXPECT_THROW(fifo.pop(7), std::logic_error);
}

TEST(Fifo, FreesAPoppedEntryInTheNextCycle) {
    ClockDomain domain("domain", ClockMode::Fast, 100);
    Fifo<int> fifo("fifo", 1, domain);
    fifo.push(0, 1);
    EXPECT_FALSE(fifo.can_push(1));
    EXPECT_EQ(fifo.pop(1), 1);
    EXPECT_FALSE(fifo.can_push(1));
    EXPECT_THROW(fifo.push(1, 2), std::logic_error);
    EXPECT_TRUE(fifo.can_push(2));
}

// Within a cycle the answers must not depend on which end is asked first, and nothing is lost or doubled.
TEST(Fifo, DoesNotShowTheOrderOfItsEnds) {
    for (const std::size_t depth : {1U, 2U, 3U, 8U}) {
        std::vector<std::vector<int>> seen(2);
        for (const bool reader_first : {false, true}) {
            start_fresh_kernel();
            ClockDomain domain("domain", ClockMode::Fast, 100);
            Fifo<int> fifo("fifo", depth, domain);
            std::mt19937 random(1);
            int next = 0;
            for (Cycle now = 0; now < 500; ++now) {
                const auto writes = random() % 3, reads = random() % 3;
                const auto write = [&] {
                    for (std::size_t i = 0; i < writes && fifo.can_push(now); ++i) fifo.push(now, next++);
                };
                const auto read = [&] {
                    for (std::size_t i = 0; i < reads && fifo.can_pop(now); ++i) {
                        seen[reader_first].push_back(int(now) * 1000 + fifo.pop(now));
                    }
                };
                if (reader_first) read();
                write();
                if (!reader_first) read();
            }
        }
        EXPECT_EQ(seen[0], seen[1]);
        EXPECT_GT(seen[0].size(), 100U);
    }
}

// Passes items on after a fixed delay; the first of a chain makes them.
class Relay final : public ClockedUnit {
  public:
    Relay(sc_core::sc_module_name name, ClockDomain& domain, std::uint32_t delay, int to_make = 0)
        : ClockedUnit(name, domain), pipeline_(delay, 64), to_make_(to_make) {}
    sc_core::sc_port<Fifo<int>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> in{"in"};
    sc_core::sc_port<Fifo<int>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> out{"out"};
    int received = 0;

    [[nodiscard]] Cycle next_event(Cycle now) const override {
        return to_make_ > 0 ? now + 1 : std::max(now + 1, pipeline_.ready_at());
    }
    [[nodiscard]] std::string describe() const override { return "relay state"; }

  protected:
    Activity tick(Cycle now) override {
        bool is_busy = false;
        if (pipeline_.is_ready(now) && (out.size() == 0 || out->can_push(now))) {
            const int item = pipeline_.pop();
            ++received;
            if (out.size() > 0) out->push(now, item);
            is_busy = true;
        }
        if (in.size() > 0 && in->can_pop(now) && !pipeline_.is_full()) {
            pipeline_.push(now, in->pop(now));
            is_busy = true;
        } else if (to_make_ > 0 && !pipeline_.is_full()) {
            pipeline_.push(now, to_make_--);
            is_busy = true;
        }
        if (is_busy) return Activity::Busy;
        return in.size() > 0 && in->can_pop(now) ? Activity::Blocked : Activity::Waiting;
    }

  private:
    Pipeline<int> pipeline_;
    int to_make_;
};

struct ChainRun {
    Cycle cycles = 0;
    std::vector<CycleAccount> accounts;
    bool operator==(const ChainRun&) const = default;
};

ChainRun run_chain(ClockMode mode, bool is_reversed) {
    start_fresh_kernel();
    ClockDomain domain("domain", mode, 10'000);
    Fifo<int> first("first", 2, domain), second("second", 2, domain);
    std::unique_ptr<Relay> maker, middle, end;
    const auto make_maker = [&] { maker = std::make_unique<Relay>("maker", domain, 3, 50); };
    const auto make_middle = [&] { middle = std::make_unique<Relay>("middle", domain, 700); };
    const auto make_end = [&] { end = std::make_unique<Relay>("end", domain, 11); };
    if (is_reversed) {
        make_end(), make_middle(), make_maker();
    } else {
        make_maker(), make_middle(), make_end();
    }
    maker->out(first);
    middle->in(first);
    middle->out(second);
    end->in(second);
    ChainRun run;
    run.cycles = domain.run([&] { return end->received == 50; });
    for (const Relay* unit : {maker.get(), middle.get(), end.get()})
        run.accounts.push_back(unit->cycle_account());
    return run;
}

TEST(ClockDomain, GivesTheSameCyclesInBothModesAndInEveryOrder) {
    const ChainRun expected = run_chain(ClockMode::Fast, false);
    EXPECT_EQ(run_chain(ClockMode::Fast, true), expected);
    EXPECT_EQ(run_chain(ClockMode::Verify, false), expected);
    EXPECT_EQ(run_chain(ClockMode::Verify, true), expected);
    // One register a channel, three delays, then one item a cycle.
    EXPECT_EQ(expected.cycles, 3U + 1U + 700U + 1U + 11U + 49U + 1U);
}

TEST(ClockDomain, AccountsForEveryCycleOfEveryUnit) {
    const ChainRun run = run_chain(ClockMode::Fast, false);
    for (const CycleAccount& account : run.accounts) {
        EXPECT_EQ(account.total(), run.cycles);
        EXPECT_GT(account.busy, 0U);
    }
    EXPECT_EQ(run.accounts[2].idle, 3U + 1U + 700U + 1U);
}

class Stuck final : public ClockedUnit {
  public:
    Stuck(sc_core::sc_module_name name, ClockDomain& domain, Cycle next)
        : ClockedUnit(name, domain), next_(next) {}
    [[nodiscard]] Cycle next_event(Cycle now) const override {
        return next_ == no_cycle ? no_cycle : now + next_;
    }
    [[nodiscard]] std::string describe() const override { return "waits for Godot"; }

  protected:
    Activity tick(Cycle) override { return Activity::Waiting; }

  private:
    Cycle next_;
};

class Watchdog : public testing::TestWithParam<std::pair<ClockMode, Cycle>> {};

TEST_P(Watchdog, FailsTheRunWithEveryUnitsState) {
    start_fresh_kernel();
    ClockDomain domain("domain", GetParam().first, 1'000);
    Stuck unit("stuck", domain, GetParam().second);
    try {
        domain.run([] { return false; });
        FAIL() << "a run without progress ended";
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("stuck: waits for Godot"), std::string::npos)
            << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(BothModes, Watchdog,
                         testing::Values(std::pair{ClockMode::Fast, no_cycle},
                                         std::pair{ClockMode::Fast, Cycle{1}},
                                         std::pair{ClockMode::Verify, Cycle{1}}));

class Thrower final : public ClockedUnit {
  public:
    using ClockedUnit::ClockedUnit;
    [[nodiscard]] Cycle next_event(Cycle now) const override { return now + 1; }
    [[nodiscard]] std::string describe() const override { return {}; }

  protected:
    Activity tick(Cycle) override { throw std::logic_error("broken invariant"); }
};

TEST(ClockDomain, PassesAUnitsExceptionOnUnchanged) {
    for (const ClockMode mode : {ClockMode::Fast, ClockMode::Verify}) {
        start_fresh_kernel();
        ClockDomain domain("domain", mode, 1'000);
        Thrower unit("thrower", domain);
        EXPECT_THROW(domain.run([] { return false; }), std::logic_error);
    }
}

}  // namespace
}  // namespace rtu::sim
