#pragma once

#include <cstdint>
#include <string>
#include <systemc>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_counters.hpp"
#include "sim/memory_message.hpp"
#include "sim/pipeline.hpp"

namespace rtu::sim {

/// Memory of one latency and one bandwidth, which knows no rows: what an RTL testbench has below its cache.
///
/// One request at a time is on the bus, for ceil(bytes / bytes_per_cycle) cycles; the next is taken, from the
/// input that is asked first in that cycle, when the bus is free. Unloaded read, from request seen to reply
/// sent: ceil(bytes / bytes_per_cycle) + latency_cycles. Replies leave in the order of the requests, one a
/// cycle; one that cannot leave holds up those behind it. Writes take bandwidth only.
class FlatMemory final : public ClockedUnit {
  public:
    /// `client_count` request channels; a request's `source` picks the reply channel.
    FlatMemory(sc_core::sc_module_name name, ClockDomain& domain, const Config::Memory& config,
               std::size_t client_count);

    sc_core::sc_vector<sc_core::sc_port<Fifo<MemoryRequest>>> requests_in;
    sc_core::sc_vector<sc_core::sc_port<PushIf<MemoryReply>>> replies_out;

    [[nodiscard]] const FlatMemoryCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws std::logic_error unless every read was answered.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;

  private:
    struct Reply {
        MemoryReply message;
        std::uint8_t client = 0;
    };

    [[nodiscard]] Activity send_reply(Cycle now);
    [[nodiscard]] Activity accept(Cycle now);
    void transfer(Cycle now, const MemoryRequest& request);

    Config::Memory config_;
    Pipeline<Reply> replies_;
    Cycle bus_free_at_ = 0;
    FlatMemoryCounters counters_;
};

}  // namespace rtu::sim
