#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/fifo.hpp"
#include "sim/link_message.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Hands the rays of a supply to the RTUs in order: up to `rays_per_cycle` a cycle, round robin over the
/// RTUs that have room, one ray an RTU and cycle. Behind a link it hands over only rays that have arrived.
class RaySource final : public ClockedUnit {
  public:
    RaySource(sc_core::sc_module_name name, ClockDomain& domain, RaySupply& rays,
              std::uint32_t rays_per_cycle, std::uint32_t rtu_count);

    sc_core::sc_vector<sc_core::sc_port<Fifo<RayMessage>>> rays_out;  ///< [rtu_count]
    /// Of a link; unbound: every ray is there from the start.
    sc_core::sc_port<Fifo<BatchArrival>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> arrivals_in{"arrivals_in"};

    /// Rays handed over.
    [[nodiscard]] std::uint32_t ray_count() const { return ray_count_; }
    /// True when no ray is left.
    [[nodiscard]] bool is_done() const { return !next_ray_; }
    [[nodiscard]] double share() const { return rays_.share(); }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;
    void end_of_elaboration() override;

  private:
    void take_arrivals(Cycle now);
    void take_next_ray();

    RaySupply& rays_;
    std::uint32_t rays_per_cycle_;
    std::optional<SuppliedRay> next_ray_;
    std::uint32_t ray_count_ = 0;
    std::uint32_t next_rtu_ = 0;
    std::uint64_t arrived_ = 0;  // rays
};

}  // namespace rtu::sim
