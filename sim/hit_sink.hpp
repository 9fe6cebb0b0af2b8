#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "sim/clocked_unit.hpp"
#include "sim/fifo.hpp"
#include "sim/link_message.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Told the hit of each ray, in the order of the rays.
using HitConsumer = std::function<void(const std::optional<model::Hit>& hit)>;

/// Takes every finished ray at once, and hands the hits on in the order of the rays. Holds only the hits of
/// rays that have overtaken one that is still under way.
class HitSink final : public ClockedUnit {
  public:
    HitSink(sc_core::sc_module_name name, ClockDomain& domain, HitConsumer consumer, std::uint32_t rtu_count);

    sc_core::sc_vector<sc_core::sc_port<Fifo<HitMessage>>> hits_in;  ///< [rtu_count]
    /// To a link's host; unbound: nobody is told.
    sc_core::sc_port<Fifo<ItemsFinished>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> finished_out{"finished_out"};

    /// Rays returned.
    [[nodiscard]] std::uint64_t received() const { return received_; }
    [[nodiscard]] Cycle next_event(Cycle) const override { return no_cycle; }
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;

  private:
    void take(const HitMessage& message);

    HitConsumer consumer_;
    std::deque<std::optional<HitMessage>> waiting_;  // of the rays from `next_` on
    std::uint32_t next_ = 0;                         // the ray whose hit is handed on next
    std::uint64_t received_ = 0;
};

}  // namespace rtu::sim
