#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/config.hpp"
#include "sim/memory_counters.hpp"
#include "sim/memory_message.hpp"
#include "sim/pipeline.hpp"

namespace rtu::sim {

/// One DRAM channel: a bounded queue, banks with one row buffer each, one command a cycle, one data bus.
///
/// The scheduler is first-ready, first-come-first-served (FR-FCFS): the oldest request whose row is open goes
/// first; otherwise the oldest request whose bank can be activated or precharged, and a row is not closed
/// while the queue holds requests for it. A stream of row hits may hold up another row of its bank as long as
/// it lasts: there is no age limit. Not modelled: refresh, t_ras, t_faw, bus turn-around, write recovery.
class DramChannel {
  public:
    /// Where a request goes within its channel.
    struct Place {
        std::uint32_t bank = 0;
        std::uint64_t row = 0;
    };

    explicit DramChannel(const Config::Dram& config);

    [[nodiscard]] bool is_full() const { return queue_.size() == config_.queue_entries; }
    /// Queues a request; a column access may follow in the same cycle.
    void accept(const MemoryRequest& request, Place place, Cycle now);
    /// Issues at most one command; whether it did.
    bool issue(Cycle now, DramCounters& counters);

    /// Replies to reads, in the order of their data on the bus: ready latency_cycles after the last byte.
    [[nodiscard]] Pipeline<MemoryReply>& replies() { return replies_; }
    /// The earliest cycle in which a command or a reply can leave; no_cycle when the channel is empty.
    [[nodiscard]] Cycle next_event() const;
    [[nodiscard]] std::size_t queue_size() const { return queue_.size(); }

  private:
    enum class RowState : std::uint8_t { Hit, Miss, Conflict };
    struct Entry {
        MemoryRequest request;
        Place place;
        RowState found = RowState::Hit;  // what its own commands had to do so far
    };
    struct Bank {
        std::optional<std::uint64_t> open_row;
        Cycle ready_at = 0;  // for its next command
    };

    [[nodiscard]] bool is_row_open(const Entry& entry) const {
        return banks_[entry.place.bank].open_row == entry.place.row;
    }
    [[nodiscard]] Cycle earliest_column(const Bank& bank) const;
    bool issue_column(Cycle now, DramCounters& counters);
    bool issue_row(Cycle now);
    void transfer(Cycle now, const Entry& entry, DramCounters& counters);
    [[nodiscard]] Cycle earliest_command() const;
    /// Bit i: a queued request wants the open row of bank i.
    [[nodiscard]] std::uint64_t banks_with_wanted_row() const;

    Config::Dram config_;
    std::vector<Entry> queue_;  // oldest first
    std::vector<Bank> banks_;
    Cycle bus_free_at_ = 0;
    Cycle next_command_at_ = no_cycle;  // no command can be issued before
    Pipeline<MemoryReply> replies_;
};

}  // namespace rtu::sim
