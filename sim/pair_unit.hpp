#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/counters.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_message.hpp"
#include "sim/pair_tester.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Tests the pairs of fetched leaves. Each of `testers` takes one leaf at a time and holds it for `ii_cycles`
/// an issue: one issue a pair, or one a triangle in mode `single`. The first pass of the test
/// (model::test_pair) is over `latency_cycles` after the last issue began; a leaf with triangles that it left
/// then holds a hit unit, for `hit_cycles` a triangle that becomes the best hit, `reject_cycles` another one,
/// and `side_cycles` more where the first pass left the sides open. Without hit units the result leaves after
/// the first pass, and a pair with two exact tests in mode `dual_shared`, in which one unit does them, holds
/// the tester for `replay_cycles` more.
class PairUnit final : public ClockedUnit {
  public:
    PairUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu::Pair& config,
             RaySlots& slots);

    sc_core::sc_port<Fifo<MemoryReply>> leaves_in{"leaves_in"};  ///< tag = slot
    sc_core::sc_port<Fifo<SlotToken>> results_out{"results_out"};

    [[nodiscard]] const PairCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws when a leaf is inside.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;

  private:
    [[nodiscard]] LeafWork test_leaf(SlotToken token);
    [[nodiscard]] bool is_replay(const model::PairVisit& visit) const;
    [[nodiscard]] std::uint32_t tester_cycles(const model::PairVisit& visit) const;
    [[nodiscard]] std::uint32_t hit_cycles(const model::PairVisit& visit) const;

    Config::Rtu::Pair config_;
    RaySlots& slots_;
    std::vector<PairTester> testers_;
    PairCounters counters_;
};

}  // namespace rtu::sim
