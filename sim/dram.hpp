#pragma once

#include <cstdint>
#include <string>
#include <systemc>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/dram_channel.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_counters.hpp"
#include "sim/memory_message.hpp"

namespace rtu::sim {

/// Main memory: independent channels, each with banks, row buffers, FR-FCFS scheduling and a data bus (see
/// DramChannel). Requests are taken in order, and wait while their channel's queue is full. Writes take
/// bandwidth only.
///
/// Address map, from the lowest bits: byte in the interleaving block, channel, block in the row, bank, row.
/// Unloaded read, from request seen to reply sent: t_cas + ceil(bytes / bytes_per_cycle) + latency_cycles
/// when the row is open, t_rcd more when the bank is closed, t_rp + t_rcd more when another row is open.
class Dram final : public ClockedUnit {
  public:
    /// `interleave_bytes`: consecutive bytes in one channel, a power of two and a divisor of the row; a
    /// request must not cross it (the L2's line size).
    Dram(sc_core::sc_module_name name, ClockDomain& domain, const Config::Dram& config,
         std::uint32_t interleave_bytes);

    sc_core::sc_port<Fifo<MemoryRequest>> requests_in{"requests_in"};
    sc_core::sc_port<PushIf<MemoryReply>> replies_out{"replies_out"};

    [[nodiscard]] const DramCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws std::logic_error unless every read was answered and every counter adds up. Writes may still be
    /// queued: nobody waits for them.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;

  private:
    struct Target {
        std::size_t channel;
        DramChannel::Place place;
    };

    [[nodiscard]] Target target(const MemoryRequest& request) const;
    [[nodiscard]] Activity send_replies(Cycle now);
    [[nodiscard]] Activity accept(Cycle now);
    [[nodiscard]] bool issue(Cycle now);

    Config::Dram config_;
    std::uint32_t interleave_bytes_;
    std::vector<DramChannel> channels_;
    Cycle next_event_ = no_cycle;  // of the channels
    DramCounters counters_;
};

}  // namespace rtu::sim
