#pragma once

#include <cstdint>
#include <string>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/counters.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_message.hpp"
#include "sim/pipeline.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Tests the children of fetched nodes. `boxes_per_cycle` lanes take nodes in order: as many whole nodes a
/// cycle as the lanes hold, or one node over several cycles when it has more children than there are lanes. A
/// node takes as many lanes as a node can have children, or with `packs_nodes` as it has. A result leaves
/// `latency_cycles` after the cycle in which its last child entered.
class BoxUnit final : public ClockedUnit {
  public:
    BoxUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu::Box& config,
            RaySlots& slots);

    sc_core::sc_port<Fifo<MemoryReply>> nodes_in{"nodes_in"};  ///< tag = slot
    sc_core::sc_port<Fifo<SlotToken>> results_out{"results_out"};

    [[nodiscard]] const BoxCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;

  private:
    void retire(Cycle now);
    Activity issue(Cycle now);

    Config::Rtu::Box config_;
    RaySlots& slots_;
    Pipeline<SlotToken> pipeline_;
    Cycle lanes_free_at_ = 0;
    BoxCounters counters_;
};

}  // namespace rtu::sim
