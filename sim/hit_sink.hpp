#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/fifo.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Takes every finished ray at once, and keeps its hit.
class HitSink final : public ClockedUnit {
  public:
    HitSink(sc_core::sc_module_name name, ClockDomain& domain, std::uint32_t ray_count,
            std::uint32_t rtu_count);

    sc_core::sc_vector<sc_core::sc_port<Fifo<HitMessage>>> hits_in;  ///< [rtu_count]

    [[nodiscard]] bool is_done() const { return received_ == is_received_.size(); }
    [[nodiscard]] std::size_t received() const { return received_; }
    /// The hits [ray_count], once all have come.
    [[nodiscard]] std::vector<std::optional<model::Hit>> take_hits() { return std::move(hits_); }
    [[nodiscard]] Cycle next_event(Cycle) const override { return no_cycle; }
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;

  private:
    std::vector<std::optional<model::Hit>> hits_;
    std::vector<bool> is_received_;
    std::size_t received_ = 0;
};

}  // namespace rtu::sim
