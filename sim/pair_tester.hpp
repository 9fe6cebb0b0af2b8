#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/config.hpp"
#include "sim/counters.hpp"
#include "sim/cycle.hpp"
#include "sim/fifo.hpp"
#include "sim/pipeline.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// What a leaf asks of a pair tester.
struct LeafWork {
    SlotToken token;
    std::uint32_t tester_cycles = 0;  ///< that it holds the entrance of the tester
    std::uint32_t hit_cycles = 0;     ///< that it holds a hit unit; 0: no triangle is left to one
};

/// One pair tester: the first pass of the pair test, and `hit_units` units behind it, each of which decides
/// one leaf's survivors exactly, one after the other.
///
/// The first pass moves as a whole, or stands still when the leaf at its end can neither leave nor go on: a
/// miss leaves as a result, a survivor goes into the queue of the hit units. One result leaves a cycle, that
/// of a hit unit (the lowest index) before a miss; so misses overtake survivors. Without hit units the whole
/// test lies within the pipeline, of which any number of results leaves, and bubbles close up.
class PairTester {
  public:
    explicit PairTester(const Config::Rtu::Pair& config);

    /// The output end of a cycle: gives away results, and starts hit units.
    void retire(Cycle now, Fifo<SlotToken>& results, PairCounters& counters);
    /// After retire().
    [[nodiscard]] bool can_issue() const { return !is_standing_ && !is_held() && !is_full_; }
    void issue(const LeafWork& leaf);
    /// Whether a leaf holds the entrance.
    [[nodiscard]] bool is_held() const { return held_until_ > moved_cycles_; }
    /// Whether the first pass could not move in this cycle.
    [[nodiscard]] bool is_standing() const { return is_standing_; }

    /// The earliest cycle after `now` in which something happens of itself.
    [[nodiscard]] Cycle next_event(Cycle now) const;
    /// Leaves inside.
    [[nodiscard]] std::size_t size() const { return size_; }

  private:
    enum class Offer : std::uint8_t { None, HitUnit, Miss };
    struct Survivor {
        SlotToken token;
        std::uint32_t hit_cycles = 0;
        Cycle ready_cycle = 0;
    };
    struct HitUnit {
        SlotToken token;
        Cycle start_cycle = 0, done_cycle = 0, free_cycle = 0;
        bool is_taken = false;
    };

    void drain(Cycle now, Fifo<SlotToken>& results);
    void give(Cycle now, Fifo<SlotToken>& results, SlotToken token);
    void choose_offer(Cycle now, bool is_miss);
    void retire_hit(Cycle now, Fifo<SlotToken>& results, PairCounters& counters);
    void leave_first_pass(Cycle now, Fifo<SlotToken>& results);
    void start_hit(Cycle now, PairCounters& counters);

    std::uint32_t ii_cycles_;
    std::size_t entries_, size_ = 0;
    // The time of the first pass is the number of cycles in which it moved.
    Pipeline<LeafWork> first_pass_;
    Cycle held_until_ = 0;
    Cycle moved_cycles_ = 0;     // before this cycle
    Cycle standing_cycles_ = 0;  // so far
    bool is_standing_ = false;   // in this cycle
    bool is_full_ = false;       // likewise
    Pipeline<Survivor> survivors_;
    std::vector<HitUnit> hit_units_;
    Offer offer_ = Offer::None;
    std::size_t offered_unit_ = 0;  // of Offer::HitUnit
};

}  // namespace rtu::sim
