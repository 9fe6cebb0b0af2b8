#pragma once

#include <string>
#include <vector>

#include "sim/machine.hpp"
#include "sim/rtu.hpp"

namespace rtu::sim {

/// An RTU of a running machine, and the channel of its L1's requests to the memory below.
struct RtuView {
    const Rtu& rtu;
    const Fifo<MemoryRequest>& l1_requests;
};

/// A channel and its name, like `rtu0.requests`.
struct NamedChannel {
    std::string name;
    const ChannelView* channel = nullptr;
};

/// What an observer may read of a running machine.
struct MachineView {
    const ClockDomain& domain;  ///< with all units
    std::vector<RtuView> rtus;
    std::vector<NamedChannel> channels;  ///< all of them
};

/// Looks on while a machine runs.
class MachineObserver : public CycleObserver {
  public:
    /// Told once, before the first cycle, when everything is built. The machine lives until after the last
    /// cycle.
    virtual void attach(const MachineView& machine) = 0;
};

/// As simulate(), with someone looking on; the result is the same. Costs nothing where nobody looks.
[[nodiscard]] MachineResult simulate_observed(const Config& config, const model::MemoryImage& image,
                                              RaySupply& rays, model::RayKind kind, const HitConsumer& on_hit,
                                              MachineObserver& observer, ClockMode mode = ClockMode::Fast);

}  // namespace rtu::sim
