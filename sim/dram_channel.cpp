#include "sim/dram_channel.hpp"

#include <algorithm>

namespace rtu::sim {

DramChannel::DramChannel(const Config::Dram& config)
    : config_(config),
      banks_(config.banks),
      // Room for a burst a cycle from column access to reply.
      replies_(config.latency_cycles, std::size_t(config.t_cas_cycles) + config.latency_cycles + 2) {
    queue_.reserve(config.queue_entries);
}

void DramChannel::accept(const MemoryRequest& request, Place place, Cycle now) {
    queue_.push_back({.request = request, .place = place});
    next_command_at_ = now;
}

Cycle DramChannel::next_event() const { return std::min(next_command_at_, replies_.ready_at()); }

bool DramChannel::issue(Cycle now, DramCounters& counters) {
    if (now < next_command_at_) return false;
    const bool has_issued = issue_column(now, counters) || issue_row(now);
    if (queue_.empty()) {
        next_command_at_ = no_cycle;
    } else {
        next_command_at_ = has_issued ? now + 1 : std::max(now + 1, earliest_command());
    }
    return has_issued;
}

// The bank must be ready, and the bus free when the data comes: the access is not issued earlier than that,
// so that the choice among row hits is made as late as possible.
Cycle DramChannel::earliest_column(const Bank& bank) const {
    const Cycle bus = bus_free_at_ > config_.t_cas_cycles ? bus_free_at_ - config_.t_cas_cycles : 0;
    return std::max(bank.ready_at, bus);
}

bool DramChannel::issue_column(Cycle now, DramCounters& counters) {
    const auto chosen = std::ranges::find_if(queue_, [&](const Entry& entry) {
        return is_row_open(entry) && earliest_column(banks_[entry.place.bank]) <= now &&
               (entry.request.is_write || !replies_.is_full());
    });
    if (chosen == queue_.end()) return false;
    transfer(now, *chosen, counters);
    queue_.erase(chosen);
    return true;
}

void DramChannel::transfer(Cycle now, const Entry& entry, DramCounters& counters) {
    const std::uint32_t burst_cycles =
        (entry.request.size_bytes + config_.bytes_per_cycle - 1) / config_.bytes_per_cycle;
    bus_free_at_ = now + config_.t_cas_cycles + burst_cycles;
    banks_[entry.place.bank].ready_at = now + burst_cycles;
    counters.bus_busy_cycles += burst_cycles;
    if (entry.found == RowState::Hit) ++counters.row_hits;
    if (entry.found == RowState::Miss) ++counters.row_misses;
    if (entry.found == RowState::Conflict) ++counters.row_conflicts;
    if (!entry.request.is_write) replies_.push(bus_free_at_, {entry.request.address, entry.request.tag});
}

// Opens or closes a row for the oldest request whose bank allows it.
bool DramChannel::issue_row(Cycle now) {
    const std::uint64_t wanted = banks_with_wanted_row();
    for (Entry& entry : queue_) {
        Bank& bank = banks_[entry.place.bank];
        if (bank.ready_at > now || (wanted >> entry.place.bank & 1U) != 0) continue;
        if (bank.open_row) {
            bank.open_row.reset();
            bank.ready_at = now + config_.t_rp_cycles;
            entry.found = RowState::Conflict;
        } else {
            bank.open_row = entry.place.row;
            bank.ready_at = now + config_.t_rcd_cycles;
            if (entry.found == RowState::Hit) entry.found = RowState::Miss;
        }
        return true;
    }
    return false;
}

Cycle DramChannel::earliest_command() const {
    const std::uint64_t wanted = banks_with_wanted_row();
    Cycle earliest = no_cycle;
    for (const Entry& entry : queue_) {
        const Bank& bank = banks_[entry.place.bank];
        if (is_row_open(entry)) {
            earliest = std::min(earliest, earliest_column(bank));
        } else if ((wanted >> entry.place.bank & 1U) == 0) {
            earliest = std::min(earliest, bank.ready_at);
        }
    }
    return earliest;
}

std::uint64_t DramChannel::banks_with_wanted_row() const {
    std::uint64_t banks = 0;
    for (const Entry& entry : queue_) {
        if (is_row_open(entry)) banks |= std::uint64_t(1) << entry.place.bank;
    }
    return banks;
}

}  // namespace rtu::sim
