#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/counters.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_message.hpp"
#include "sim/pipeline.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Tests the pairs of fetched leaves. Each of `testers` takes one leaf at a time and holds it for `ii_cycles`
/// an issue: one issue a pair, or one a triangle in mode `single`; in mode `dual_shared` a pair both of
/// whose triangles need the exact pass (model::test_pair) takes `replay_cycles` more, because one unit does
/// that pass. A result
/// leaves `latency_cycles` after the last issue began, and that begins later by all replays before its end.
class PairUnit final : public ClockedUnit {
  public:
    PairUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu::Pair& config,
             RaySlots& slots);

    sc_core::sc_port<Fifo<MemoryReply>> leaves_in{"leaves_in"};  ///< tag = slot
    sc_core::sc_port<Fifo<SlotToken>> results_out{"results_out"};

    [[nodiscard]] const PairCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;

  private:
    struct Tester {
        Cycle free_at = 0;
        Pipeline<SlotToken> pipeline;
    };

    void retire(Cycle now);
    void issue(Tester& tester, Cycle now);
    [[nodiscard]] std::uint32_t test_leaf(RaySlot& slot);

    Config::Rtu::Pair config_;
    RaySlots& slots_;
    std::vector<Tester> testers_;
    PairCounters counters_;
};

}  // namespace rtu::sim
