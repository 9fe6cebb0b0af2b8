#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "study/timeline/timeline_recorder.hpp"
#include "tests/sim/machine_fixture.hpp"

namespace rtu::study {
namespace {

using model::RayKind;
using sim::Cycle;

constexpr TimelineWindow everything{0, 1'000'000'000};

struct Observed {
    sim::MachineResult result;
    Timeline timeline;
};

struct Case {
    const char* name;
    sim::Config config;
};

void PrintTo(const Case& machine, std::ostream* out) { *out << machine.name; }

sim::Config three_rtus() {
    sim::Config config = test::tiny_machine();
    config.rtu.count = 3;
    return config;
}
sim::Config flat_memory() {
    sim::Config config;
    config.memory = {sim::MemoryModel::Flat, 30, 8};
    config.rtu.scheduler.latency_cycles = 0;
    return config;
}

class TimelineOf : public testing::TestWithParam<Case> {
  protected:
    TimelineOf() { rays_[17].direction = {0, 0, 0}; }  // in and out in one cycle
    Observed observe(const TimelineWindow& window, sim::ClockMode mode = sim::ClockMode::Fast) {
        TimelineRecorder recorder(window);
        sim::SpanSupply supply(rays_);
        std::vector<std::optional<model::Hit>> hits;
        Observed observed;
        observed.result = sim::simulate_observed(
            GetParam().config, image_, supply, RayKind::ClosestHit,
            [&](const auto& hit) { hits.push_back(hit); }, recorder, mode);
        observed.result.hits = std::move(hits);
        observed.timeline = recorder.finish(observed.result.cycles);
        return observed;
    }

    model::MemoryImage image_ = test::image_of(test::triangle_soup(400, 3, 0.15F));
    std::vector<model::Ray> rays_ = test::rays_into_unit_cube(250, 4);
};

std::uint64_t counter(const sim::MachineResult& result, std::string_view unit, std::string_view name) {
    std::uint64_t sum = 0;
    for (const auto* units : {&result.units, &result.memory}) {
        for (const sim::UnitResult& u : *units) {
            for (const sim::CounterValue& c : u.counters) {
                if (u.name.ends_with(unit) && c.name == name) sum += c.value;
            }
        }
    }
    return sum;
}

// The name in results: "rtu0.box" is "box" when there is one RTU.
bool is_unit(const std::string& unit, const std::string& in_result) {
    return unit == in_result || unit.ends_with("." + in_result);
}

TEST_P(TimelineOf, AccountsForEveryCycleOfEveryUnitAsTheRunDoes) {
    const Observed observed = observe(everything);
    const Timeline& timeline = observed.timeline;
    std::vector<sim::CycleAccount> accounts(timeline.units.size());
    std::vector<Cycle> ends(timeline.units.size(), 0);
    for (const UnitSpan& span : timeline.unit_spans) {
        ASSERT_EQ(span.begin, ends[span.unit]) << "spans of a unit must meet";
        ends[span.unit] = span.end;
        sim::CycleAccount& account = accounts[span.unit];
        std::uint64_t* const states[] = {&account.idle, &account.starved, &account.blocked, &account.busy};
        *states[std::size_t(span.state)] += span.end - span.begin;
    }
    std::size_t found = 0;
    for (const auto* units : {&observed.result.units, &observed.result.memory}) {
        for (const sim::UnitResult& unit : *units) {
            for (std::size_t i = 0; i < accounts.size(); ++i) {
                if (!is_unit(timeline.units[i], unit.name)) continue;
                EXPECT_EQ(accounts[i], unit.cycles) << unit.name;
                ++found;
            }
        }
    }
    EXPECT_EQ(found, observed.result.units.size() + observed.result.memory.size());
    for (const Cycle end : ends) EXPECT_EQ(end, observed.result.cycles);
}

TEST_P(TimelineOf, FollowsEveryRayThroughItsSlot) {
    const Observed observed = observe(everything);
    const Timeline& timeline = observed.timeline;
    EXPECT_EQ(timeline.ray_spans.size(), rays_.size() - 1);  // all but the one that was not traversed
    std::uint64_t held = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<SlotSpan>> waits;  // of an RTU's ray
    for (const SlotSpan& span : timeline.slot_spans) waits[{span.rtu, span.ray}].push_back(span);
    for (const RaySpan& ray : timeline.ray_spans) {
        held += ray.end - ray.begin;
        Cycle at = ray.begin;
        for (const SlotSpan& span : waits.at({ray.rtu, ray.ray})) {
            ASSERT_EQ(span.slot, ray.slot);
            ASSERT_EQ(span.begin, at) << "a ray is at one place at a time";
            at = span.end;
        }
        ASSERT_EQ(at, ray.end);
    }
    EXPECT_EQ(held, counter(observed.result, "scheduler", "slot_cycles"));
}

TEST_P(TimelineOf, HasEveryMemoryRequest) {
    const Observed observed = observe(everything);
    std::map<RequestSpan::Kind, std::uint64_t> reads, writes;
    std::uint64_t node_cycles = 0, node_wait = 0;
    for (const RequestSpan& request : observed.timeline.requests) {
        ++(request.is_write ? writes : reads)[request.kind];
        if (request.is_write) continue;
        ASSERT_LT(request.begin, request.end);
        if (request.kind == RequestSpan::Kind::Node) node_cycles += request.end - request.begin;
    }
    for (const SlotSpan& span : observed.timeline.slot_spans) {
        if (span.wait == SlotWait::NodeFetch) node_wait += span.end - span.begin;
    }
    using enum RequestSpan::Kind;
    EXPECT_EQ(reads[Node], counter(observed.result, "scheduler", "node_fetches"));
    EXPECT_EQ(reads[Leaf], counter(observed.result, "scheduler", "leaf_fetches"));
    EXPECT_EQ(reads[L1Miss], counter(observed.result, "l1", "misses"));
    EXPECT_EQ(node_cycles, node_wait);
    const std::uint32_t block = std::min(4U, GetParam().config.rtu.stack_entries);
    EXPECT_EQ(writes[Stack] * block, counter(observed.result, "scheduler", "spilled_entries"));
    EXPECT_EQ(reads[Stack] * block, counter(observed.result, "scheduler", "reloaded_entries"));
}

TEST_P(TimelineOf, KnowsWhatEveryChannelHolds) {
    const Observed observed = observe(everything);
    std::vector<ChannelSample> last(observed.timeline.channels.size());
    std::uint64_t pushed = 0;
    for (const ChannelSample& sample : observed.timeline.samples) {
        ChannelSample& before = last[sample.channel];
        // What was pushed and popped went on in every cycle up to this one.
        const auto cycles = std::int64_t(sample.cycle - before.cycle);
        ASSERT_EQ(std::int64_t(sample.held),
                  before.held + cycles * (std::int64_t(before.pushed) - std::int64_t(before.popped)));
        ASSERT_LE(sample.popped, sample.held);
        ASSERT_LE(sample.held + sample.pushed, observed.timeline.channels[sample.channel].depth);
        if (observed.timeline.channels[sample.channel].name.ends_with(".nodes")) {
            pushed += std::uint64_t(cycles) * before.pushed;
        }
        before = sample;
    }
    EXPECT_GT(pushed, 0U);
}

template <class Span>
bool is_same(const Span& a, const Span& b) {
    return a.begin == b.begin && a.end == b.end;
}

void expect_same(const Timeline& a, const Timeline& b) {
    ASSERT_EQ(a.unit_spans.size(), b.unit_spans.size());
    for (std::size_t i = 0; i < a.unit_spans.size(); ++i) {
        ASSERT_TRUE(is_same(a.unit_spans[i], b.unit_spans[i]) &&
                    a.unit_spans[i].state == b.unit_spans[i].state);
    }
    EXPECT_TRUE(std::ranges::equal(a.slot_spans, b.slot_spans, is_same<SlotSpan>));
    EXPECT_TRUE(std::ranges::equal(a.ray_spans, b.ray_spans, is_same<RaySpan>));
    EXPECT_TRUE(std::ranges::equal(a.requests, b.requests, is_same<RequestSpan>));
    const auto same_sample = [](const ChannelSample& x, const ChannelSample& y) {
        return x.cycle == y.cycle && x.channel == y.channel && x.held == y.held && x.pushed == y.pushed &&
               x.popped == y.popped;
    };
    EXPECT_TRUE(std::ranges::equal(a.samples, b.samples, same_sample));
}

TEST_P(TimelineOf, IsTheSameInBothClockModesAndChangesNothing) {
    const Observed fast = observe(everything);
    const Observed verify = observe(everything, sim::ClockMode::Verify);
    expect_same(fast.timeline, verify.timeline);
    const auto alone = sim::simulate(GetParam().config, image_, rays_, RayKind::ClosestHit);
    EXPECT_EQ(fast.result.cycles, alone.cycles);
    EXPECT_EQ(fast.result.hits, alone.hits);
}

// What the whole timeline has in the window, and nothing else.
template <class Span>
std::vector<std::pair<Cycle, Cycle>> within(const std::vector<Span>& spans, const TimelineWindow& window) {
    std::vector<std::pair<Cycle, Cycle>> result;
    for (const Span& span : spans) {
        const Cycle begin = std::max(span.begin, window.from), end = std::min(span.end, window.end());
        if (begin < end) result.emplace_back(begin, end);
    }
    return result;
}

TEST_P(TimelineOf, OfAWindowIsThatPartOfTheWhole) {
    const Timeline whole = observe(everything).timeline;
    const TimelineWindow window{whole.run_cycles / 3, 150};
    const Timeline part = observe(window).timeline;
    EXPECT_EQ(within(part.unit_spans, everything), within(whole.unit_spans, window));
    EXPECT_EQ(within(part.slot_spans, everything), within(whole.slot_spans, window));
    EXPECT_EQ(within(part.ray_spans, everything), within(whole.ray_spans, window));
    EXPECT_EQ(within(part.requests, everything), within(whole.requests, window));
    EXPECT_GT(part.slot_spans.size(), 10U);
    for (const ChannelSample& sample : part.samples) {
        ASSERT_TRUE(window.from <= sample.cycle && sample.cycle < window.end());
    }
}

INSTANTIATE_TEST_SUITE_P(Machines, TimelineOf,
                         testing::Values(Case{"default", {}}, Case{"tiny", test::tiny_machine()},
                                         Case{"three_rtus", three_rtus()},
                                         Case{"flat_memory", flat_memory()}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace rtu::study
