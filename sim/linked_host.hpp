#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/host_link.hpp"
#include "sim/link_host.hpp"
#include "sim/link_message.hpp"
#include "sim/link_timeline.hpp"
#include "sim/memory_boundary.hpp"
#include "sim/unit_result.hpp"

namespace rtu::sim {

/// A host, its link, and the two channels that end in the machine.
///
///   host -> TLM-2.0 initiator | target -> link -> arrivals -> (machine)
///        <-                   |        <-
///        <- finished <------------------------------------- (machine)
class LinkedHost final : public sc_core::sc_module {
  public:
    LinkedHost(sc_core::sc_module_name name, ClockDomain& domain, const Config& config, BatchSupply& batches);

    Fifo<BatchArrival> arrivals;
    Fifo<ItemsFinished> finished;  ///< its reader takes everything at once: one item a cycle always fits

    [[nodiscard]] bool is_done() const { return host_.is_done(); }
    [[nodiscard]] std::uint64_t batch_count() const { return host_.batch_count(); }
    [[nodiscard]] const LinkCounters& counters() const { return link_.counters(); }
    /// Where the `cycles` of the run went, and throws std::logic_error unless all that was sent has arrived.
    [[nodiscard]] LinkTime check_drained(Cycle cycles);
    /// Host and link, for reports. `time` is what check_drained() gave.
    [[nodiscard]] std::vector<UnitResult> results(const LinkTime& time) const;

  private:
    LinkTimeline timeline_;
    Fifo<MemoryRequest> transfers_;
    Fifo<MemoryReply> replies_;
    LinkHost host_;
    HostLink link_;
    BoundaryInitiator initiator_;
    BoundaryTarget target_;
};

/// Cycles in which a transfer of that many bytes may move nothing that a watchdog sees.
[[nodiscard]] Cycle transfer_cycles(const Config& config, std::uint64_t bytes);

}  // namespace rtu::sim
