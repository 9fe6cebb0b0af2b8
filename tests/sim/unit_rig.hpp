#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <type_traits>
#include <vector>

#include "mock_units.hpp"
#include "sim/box_unit.hpp"
#include "sim/kernel.hpp"
#include "sim/pair_unit.hpp"
#include "sim/ray_slots.hpp"

// A box or pair unit between a source of slots and a sink.
namespace rtu::test {

/// Slots whose rays, all the same, are at the root.
inline std::vector<sim::RaySlot> started_slots(std::uint32_t count, const model::MemoryImage& image,
                                               const model::Ray& ray) {
    std::vector<sim::RaySlot> slots(count);
    for (sim::RaySlot& slot : slots)
        EXPECT_TRUE(slot.walk.start(image, {ray, {}}, model::RayKind::ClosestHit, {}));
    return slots;
}

constexpr std::size_t wide_channel = 64;  ///< never the limit

template <class Counters>
struct UnitRun {
    std::vector<Cycle> arrivals;       ///< at the sink, in order
    std::vector<std::uint32_t> slots;  ///< that arrived
    sim::CycleAccount account;
    Counters counters;
    Cycle cycles = 0;
};

/// How a unit is run.
struct UnitRig {
    std::vector<Cycle> offered;  ///< slot i is offered in this cycle; none: all in cycle 0
    std::size_t depth_out = wide_channel;
    std::function<bool(Cycle)> is_open;  ///< whether the sink takes results; empty: always
    sim::ClockMode mode = sim::ClockMode::Fast;
};

/// Runs a unit until all slots have come through it.
template <class Unit, class Config>
auto run_unit(const Config& config, std::vector<sim::RaySlot>& slots, const UnitRig& rig = {}) {
    sim::start_fresh_kernel();
    ClockDomain domain("domain", rig.mode, 100'000);
    Fifo<sim::MemoryReply> in("in", wide_channel, domain);
    Fifo<sim::SlotToken> out("out", rig.depth_out, domain);
    std::vector<Stamped<sim::MemoryReply>> script;
    for (std::uint32_t slot = 0; slot < slots.size(); ++slot) {
        script.push_back({rig.offered.empty() ? 0 : rig.offered[slot], {.address = 0, .tag = slot}});
    }
    MockSource<sim::MemoryReply> source("source", domain, script);
    Unit unit("unit", domain, config, slots);
    MockSink<sim::SlotToken> sink("sink", domain, rig.is_open);
    source.out(in);
    if constexpr (std::is_same_v<Unit, sim::BoxUnit>) {
        unit.nodes_in(in);
    } else {
        unit.leaves_in(in);
    }
    unit.results_out(out);
    sink.in(out);
    UnitRun<std::decay_t<decltype(unit.counters())>> run;
    run.cycles = domain.run([&] { return sink.received().size() == slots.size(); });
    for (const auto& [cycle, token] : sink.received()) {
        run.arrivals.push_back(cycle);
        run.slots.push_back(token.slot);
    }
    run.account = unit.cycle_account();
    run.counters = unit.counters();
    return run;
}

}  // namespace rtu::test
