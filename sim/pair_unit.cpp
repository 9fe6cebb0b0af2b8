#include "sim/pair_unit.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace rtu::sim {

PairUnit::PairUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu::Pair& config,
                   RaySlots& slots)
    : ClockedUnit(name, domain),
      config_(config),
      slots_(slots),
      testers_(config.testers, PairTester(config)) {}

Cycle PairUnit::next_event(Cycle now) const {
    Cycle next = no_cycle;
    for (const PairTester& tester : testers_) next = std::min(next, tester.next_event(now));
    return next;
}

std::string PairUnit::describe() const {
    std::size_t inside = 0;
    for (const PairTester& tester : testers_) inside += tester.size();
    return fmt::format("{} leaves waiting, {} in the testers", leaves_in->size(), inside);
}

void PairUnit::check_drained() const {
    for (const PairTester& tester : testers_) {
        RTU_CHECK(tester.size() == 0, "{}: {} leaves in a tester at the end", name(), tester.size());
    }
}

Activity PairUnit::tick(Cycle now) {
    bool is_busy = false, has_work = false;
    for (PairTester& tester : testers_) {
        tester.retire(now, *results_out[0], counters_);
        if (tester.can_issue() && leaves_in->can_pop(now)) {
            tester.issue(test_leaf({leaves_in->pop(now).tag}));
        }
        is_busy |= tester.is_held() && !tester.is_standing();
        has_work |= tester.is_held();
    }
    if (is_busy) return Activity::Busy;
    return has_work || leaves_in->can_pop(now) ? Activity::Blocked : Activity::Waiting;
}

// Tests the leaf's pairs in order; an any-hit ray stops at its first hit.
LeafWork PairUnit::test_leaf(SlotToken token) {
    RayWalk& walk = slots_[token.slot].walk;
    LeafWork work{token};
    const std::uint32_t pairs = walk.current().pair_count();
    for (std::uint32_t i = 0; i < pairs && !walk.is_satisfied(); ++i) {
        const model::PairVisit visit = walk.visit_pair(i);
        ++counters_.pair_tests;
        counters_.triangle_tests += visit.triangle_tests;
        counters_.exact_tests += visit.exact_tests;
        counters_.replays += is_replay(visit) ? 1 : 0;
        work.tester_cycles += tester_cycles(visit);
        work.hit_cycles += hit_cycles(visit);
    }
    ++counters_.leaf_visits;
    counters_.tester_cycles += work.tester_cycles;
    return work;
}

// Whether one unit makes both exact tests of a pair.
bool PairUnit::is_replay(const model::PairVisit& visit) const {
    return visit.exact_tests == 2 && (config_.hit_units > 0 || config_.mode == PairMode::DualShared);
}

std::uint32_t PairUnit::tester_cycles(const model::PairVisit& visit) const {
    const std::uint32_t issues = config_.mode == PairMode::Single ? visit.triangle_tests : 1;
    const bool waits = config_.hit_units == 0 && is_replay(visit);
    return config_.ii_cycles * issues + (waits ? config_.replay_cycles : 0);
}

std::uint32_t PairUnit::hit_cycles(const model::PairVisit& visit) const {
    if (config_.hit_units == 0) return 0;
    return config_.hit_cycles * visit.better_hits +
           config_.reject_cycles * (visit.exact_tests - visit.better_hits) +
           config_.side_cycles * visit.side_tests;
}

}  // namespace rtu::sim
