#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/link_counters.hpp"
#include "sim/link_message.hpp"
#include "sim/link_timeline.hpp"
#include "sim/link_wire.hpp"
#include "sim/memory_message.hpp"

namespace rtu::sim {

/// A link between a host and the machine. Transfers come through a TLM-2.0 target (BoundaryTarget) as reads
/// and writes: a write goes up, a read brings results down, and its address is the number of its batch. Each
/// transfer takes, in this order,
///
///   the host for `overhead_ns`          one transfer at a time, up and down together
///   a wire for bytes / bandwidth        one at a time on each of `wires`
///   `latency_ns`                        any number at once
///
/// so that one alone takes their sum, and many take as long as the slowest of the three allows. At most
/// `outstanding` are under way. What enters arrives, in its order for each direction.
class HostLink final : public ClockedUnit {
  public:
    /// With `config.count` = 0 transfers cost nothing but the channels at both ends.
    HostLink(sc_core::sc_module_name name, ClockDomain& domain, const Config::Link& config,
             std::uint32_t clock_mhz, LinkTimeline& timeline);

    sc_core::sc_port<Fifo<MemoryRequest>> transfers_in{"transfers_in"};
    sc_core::sc_port<Fifo<BatchArrival>> arrivals_out{"arrivals_out"};  ///< in the machine
    sc_core::sc_port<PushIf<MemoryReply>> replies_out{"replies_out"};   ///< to the host

    [[nodiscard]] const LinkCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws std::logic_error unless every transfer and every byte has arrived.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;
    [[nodiscard]] Activity between_events(Cycle now) const override;

  private:
    struct UnderWay {
        Cycle arrives_at = 0;
        MemoryRequest transfer;
    };

    [[nodiscard]] bool deliver(Cycle now);
    [[nodiscard]] bool accept(Cycle now);
    void start(Cycle now, const MemoryRequest& transfer);
    [[nodiscard]] bool is_working_after(Cycle now) const;
    [[nodiscard]] std::size_t in_flight() const { return up_.size() + down_.size(); }

    Config::Link config_;
    Cycle overhead_cycles_;
    Cycle latency_cycles_;
    LinkTimeline& timeline_;
    Cycle host_free_at_ = 0;
    std::vector<LinkWire> wires_;
    std::deque<UnderWay> up_, down_;  // in the order of arrival
    LinkCounters counters_;
};

}  // namespace rtu::sim
