#include "sim/pair_unit.hpp"

#include <algorithm>

namespace rtu::sim {

PairUnit::PairUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu::Pair& config,
                   RaySlots& slots)
    : ClockedUnit(name, domain), config_(config), slots_(slots) {
    const std::size_t depth = config.latency_cycles / config.ii_cycles + 1;
    testers_.assign(config.testers, {0, Pipeline<SlotToken>(config.latency_cycles, depth)});
}

Cycle PairUnit::next_event(Cycle now) const {
    Cycle next = no_cycle;
    for (const Tester& tester : testers_) {
        next = std::min(next, tester.free_at > now + 1 ? now + 1 : tester.pipeline.ready_at());
    }
    return std::max(next, now + 1);
}

std::string PairUnit::describe() const {
    std::size_t in_flight = 0;
    for (const Tester& tester : testers_) in_flight += tester.pipeline.size();
    return fmt::format("{} leaves waiting, {} in the pipelines", leaves_in->size(), in_flight);
}

Activity PairUnit::tick(Cycle now) {
    retire(now);
    bool is_busy = false;
    bool has_issued_all = true;
    for (Tester& tester : testers_) {
        if (tester.free_at <= now && leaves_in->can_pop(now)) {
            if (tester.pipeline.is_full()) {
                has_issued_all = false;
            } else {
                issue(tester, now);
            }
        }
        is_busy |= tester.free_at > now;
    }
    if (is_busy) return Activity::Busy;
    return has_issued_all ? Activity::Waiting : Activity::Blocked;
}

void PairUnit::retire(Cycle now) {
    for (Tester& tester : testers_) {
        while (tester.pipeline.is_ready(now) && results_out->can_push(now)) {
            results_out->push(now, tester.pipeline.pop());
        }
    }
}

void PairUnit::issue(Tester& tester, Cycle now) {
    const SlotToken token{leaves_in->pop(now).tag};
    const std::uint32_t held = test_leaf(slots_[token.slot]);
    ++counters_.leaf_visits;
    counters_.tester_cycles += held;
    tester.free_at = now + held;
    tester.pipeline.push(now + held - config_.ii_cycles, token);
}

// Tests the leaf's pairs in order; an any-hit ray stops at its first hit. Returns the cycles that the tester
// is held.
std::uint32_t PairUnit::test_leaf(RaySlot& slot) {
    std::uint32_t held = 0;
    const std::uint32_t pairs = slot.walk.current().pair_count();
    for (std::uint32_t i = 0; i < pairs && !slot.walk.is_satisfied(); ++i) {
        const model::PairVisit visit = slot.walk.visit_pair(i);
        ++counters_.pair_tests;
        counters_.triangle_tests += visit.triangle_tests;
        counters_.exact_tests += visit.exact_tests;
        held += config_.ii_cycles * (config_.mode == PairMode::Single ? visit.triangle_tests : 1U);
        if (config_.mode == PairMode::DualShared && visit.exact_tests == 2) {
            ++counters_.replays;
            held += config_.replay_cycles;
        }
    }
    return held;
}

}  // namespace rtu::sim
