#include "sim/pair_tester.hpp"

#include <algorithm>

namespace rtu::sim {

namespace {

// From the end of the first pass to the start in a hit unit: into the queue and out of it.
constexpr std::uint32_t queue_cycles = 2;

// Without hit units, what the pipeline holds.
std::size_t entries_of(const Config::Rtu::Pair& config) {
    return config.hit_units > 0 ? config.entries : config.latency_cycles / config.ii_cycles + 1;
}

}  // namespace

PairTester::PairTester(const Config::Rtu::Pair& config)
    : ii_cycles_(config.ii_cycles),
      entries_(entries_of(config)),
      first_pass_(config.latency_cycles, entries_),
      survivors_(queue_cycles, entries_),
      hit_units_(config.hit_units) {}

void PairTester::retire(Cycle now, Fifo<SlotToken>& results, PairCounters& counters) {
    moved_cycles_ = now - standing_cycles_;
    if (hit_units_.empty()) {
        drain(now, results);
        is_full_ = size_ == entries_;
        return;
    }
    is_full_ = size_ == entries_;  // an entry is free again in the cycle after its result left
    const bool is_miss = first_pass_.is_ready(moved_cycles_) && first_pass_.front().hit_cycles == 0;
    if (offer_ == Offer::None) choose_offer(now, is_miss);
    const bool is_taken = offer_ != Offer::None && results.can_push(now);
    is_standing_ = is_miss && !(is_taken && offer_ == Offer::Miss);
    if (is_taken && offer_ == Offer::HitUnit) retire_hit(now, results, counters);
    if (is_taken) offer_ = Offer::None;
    if (is_standing_) {
        ++standing_cycles_;
        ++counters.standing_cycles;
    } else {
        leave_first_pass(now, results);
    }
    start_hit(now, counters);
}

// The result that is offered, and stays so until it is taken: of a hit unit before a miss.
void PairTester::choose_offer(Cycle now, bool is_miss) {
    const auto unit = std::ranges::find_if(
        hit_units_, [now](const HitUnit& u) { return u.is_taken && u.done_cycle <= now; });
    offered_unit_ = std::size_t(unit - hit_units_.begin());
    offer_ = unit != hit_units_.end() ? Offer::HitUnit : is_miss ? Offer::Miss : Offer::None;
}

void PairTester::issue(const LeafWork& leaf) {
    held_until_ = moved_cycles_ + leaf.tester_cycles;
    first_pass_.push(held_until_ - ii_cycles_, leaf);
    ++size_;
}

void PairTester::give(Cycle now, Fifo<SlotToken>& results, SlotToken token) {
    results.push(now, token);
    --size_;
}

void PairTester::drain(Cycle now, Fifo<SlotToken>& results) {
    while (first_pass_.is_ready(now) && results.can_push(now)) give(now, results, first_pass_.pop().token);
}

void PairTester::retire_hit(Cycle now, Fifo<SlotToken>& results, PairCounters& counters) {
    HitUnit& unit = hit_units_[offered_unit_];
    give(now, results, unit.token);
    unit.is_taken = false;
    unit.free_cycle = now + 1;
    counters.hit_unit_cycles += unit.free_cycle - unit.start_cycle;
}

// What is at the end of the first pass goes on from there.
void PairTester::leave_first_pass(Cycle now, Fifo<SlotToken>& results) {
    if (!first_pass_.is_ready(moved_cycles_)) return;
    const LeafWork leaf = first_pass_.pop();
    if (leaf.hit_cycles > 0) {
        survivors_.push(now, {leaf.token, leaf.hit_cycles, now + queue_cycles});
    } else {
        give(now, results, leaf.token);
    }
}

void PairTester::start_hit(Cycle now, PairCounters& counters) {
    if (!survivors_.is_ready(now)) return;
    const auto unit = std::ranges::find_if(
        hit_units_, [now](const HitUnit& u) { return !u.is_taken && u.free_cycle <= now; });
    if (unit == hit_units_.end()) return;
    const Survivor survivor = survivors_.pop();
    *unit = {survivor.token, now, now + survivor.hit_cycles, 0, true};
    ++counters.survivors;
    counters.hit_wait_cycles += now - survivor.ready_cycle;
}

Cycle PairTester::next_event(Cycle now) const {
    if (is_standing_ || held_until_ > moved_cycles_ + 1) return now + 1;
    Cycle next = first_pass_.is_empty() ? no_cycle : first_pass_.ready_at() + standing_cycles_;
    for (const HitUnit& unit : hit_units_) {
        next = std::min(next, unit.is_taken ? unit.done_cycle : survivors_.ready_at());
    }
    return std::max(next, now + 1);
}

}  // namespace rtu::sim
