#include "sim/flat_memory.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace rtu::sim {

FlatMemory::FlatMemory(sc_core::sc_module_name name, ClockDomain& domain, const Config::Memory& config,
                       std::size_t client_count)
    : ClockedUnit(name, domain),
      requests_in("requests_in", client_count),
      replies_out("replies_out", client_count),
      config_(config),
      // Room for a read a cycle from request to reply.
      replies_(config.latency_cycles, std::size_t(config.latency_cycles) + 2) {}

Cycle FlatMemory::next_event(Cycle now) const { return std::max(replies_.ready_at(), now + 1); }

std::string FlatMemory::describe() const {
    std::size_t waiting = 0;
    for (const auto& requests : requests_in) waiting += requests->size();
    return fmt::format("{} requests waiting, {} reads under way", waiting, replies_.size());
}

void FlatMemory::check_drained() const {
    RTU_CHECK(counters_.reads == counters_.replies, "{}: {} reads but {} replies", name(), counters_.reads,
              counters_.replies);
}

Activity FlatMemory::tick(Cycle now) {
    const Activity replied = send_reply(now);
    const Activity accepted = accept(now);
    if (replied == Activity::Busy || accepted == Activity::Busy) return Activity::Busy;
    const bool is_blocked = replied == Activity::Blocked || accepted == Activity::Blocked;
    return is_blocked ? Activity::Blocked : Activity::Waiting;
}

Activity FlatMemory::send_reply(Cycle now) {
    if (!replies_.is_ready(now)) return Activity::Waiting;
    PushIf<MemoryReply>& channel = *replies_out[replies_.front().client].operator->();
    if (!channel.can_push(now)) {
        ++counters_.reply_stall_cycles;
        return Activity::Blocked;
    }
    channel.push(now, replies_.pop().message);
    ++counters_.replies;
    return Activity::Busy;
}

// The client that is asked first changes every cycle, so that none can starve.
Activity FlatMemory::accept(Cycle now) {
    bool is_waiting = false;
    for (std::size_t i = 0; i < requests_in.size(); ++i) {
        Fifo<MemoryRequest>& requests = *requests_in[(now + i) % requests_in.size()].operator->();
        if (!requests.can_pop(now)) continue;
        is_waiting = true;
        if (bus_free_at_ > now || (replies_.is_full() && !requests.front().is_write)) continue;
        transfer(now, requests.pop(now));
        return Activity::Busy;
    }
    return is_waiting ? Activity::Blocked : Activity::Waiting;
}

void FlatMemory::transfer(Cycle now, const MemoryRequest& request) {
    const std::uint32_t burst_cycles =
        (request.size_bytes + config_.bytes_per_cycle - 1) / config_.bytes_per_cycle;
    RTU_CHECK(burst_cycles != 0, "{}: request of 0 bytes at {}", name(), request.address);
    bus_free_at_ = now + burst_cycles;
    counters_.bus_busy_cycles += burst_cycles;
    ++(request.is_write ? counters_.writes : counters_.reads);
    (request.is_write ? counters_.write_bytes : counters_.read_bytes) += request.size_bytes;
    if (!request.is_write) {
        replies_.push(bus_free_at_, {{request.address, request.tag}, request.source});
    }
}

}  // namespace rtu::sim
