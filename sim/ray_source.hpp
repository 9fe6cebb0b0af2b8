#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/fifo.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Hands the rays of a workload to the RTUs in order: up to `rays_per_cycle` a cycle, round robin over the
/// RTUs that have room, one ray an RTU and cycle.
class RaySource final : public ClockedUnit {
  public:
    RaySource(sc_core::sc_module_name name, ClockDomain& domain, std::uint32_t ray_count,
              std::uint32_t rays_per_cycle, std::uint32_t rtu_count);

    sc_core::sc_vector<sc_core::sc_port<Fifo<RayMessage>>> rays_out;  ///< [rtu_count]

    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;

  private:
    std::uint32_t ray_count_;
    std::uint32_t rays_per_cycle_;
    std::uint32_t next_ray_ = 0;
    std::uint32_t next_rtu_ = 0;
};

}  // namespace rtu::sim
