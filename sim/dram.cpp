#include "sim/dram.hpp"

#include <algorithm>
#include <bit>

#include "model/error.hpp"

namespace rtu::sim {

Dram::Dram(sc_core::sc_module_name name, ClockDomain& domain, const Config::Dram& config,
           std::uint32_t interleave_bytes)
    : ClockedUnit(name, domain),
      config_(config),
      interleave_bytes_(interleave_bytes),
      channels_(config.channels, DramChannel(config)) {
    RTU_CHECK(std::has_single_bit(interleave_bytes) && config.row_bytes % interleave_bytes == 0,
              "{}: {} bytes do not divide a row of {}", this->name(), interleave_bytes, config.row_bytes);
    RTU_CHECK(config.banks <= 64, "{}: too many banks", this->name());
}

Cycle Dram::next_event(Cycle now) const { return std::max(next_event_, now + 1); }

std::string Dram::describe() const {
    std::size_t queued = 0;
    for (const DramChannel& channel : channels_) queued += channel.queue_size();
    return fmt::format("{} requests waiting, {} queued at channels, {} reads and {} replies so far",
                       requests_in->size(), queued, counters_.reads, counters_.replies);
}

void Dram::check_drained() const {
    const DramCounters& c = counters_;
    RTU_CHECK(c.reads == c.replies, "{}: {} reads but {} replies", name(), c.reads, c.replies);
    std::size_t queued = 0;
    for (const DramChannel& channel : channels_) queued += channel.queue_size();
    RTU_CHECK(c.reads + c.writes == c.row_hits + c.row_misses + c.row_conflicts + queued,
              "{}: {} requests but {} row hits + {} misses + {} conflicts, {} queued", name(),
              c.reads + c.writes, c.row_hits, c.row_misses, c.row_conflicts, queued);
}

// Requests are accepted before commands are issued, so that an idle channel adds no cycle of its own.
Activity Dram::tick(Cycle now) {
    if (now < next_event_ && !requests_in->can_pop(now)) return Activity::Waiting;
    const Activity replied = send_replies(now);
    const Activity accepted = accept(now);
    const bool has_issued = issue(now);
    if (replied == Activity::Busy || accepted == Activity::Busy || has_issued) return Activity::Busy;
    const bool is_blocked = replied == Activity::Blocked || accepted == Activity::Blocked;
    return is_blocked ? Activity::Blocked : Activity::Waiting;
}

// The channel that replies first changes every cycle, so that none can starve.
Activity Dram::send_replies(Cycle now) {
    Activity activity = Activity::Waiting;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        Pipeline<MemoryReply>& replies = channels_[(now + i) % channels_.size()].replies();
        while (replies.is_ready(now) && replies_out->can_push(now)) {
            replies_out->push(now, replies.pop());
            ++counters_.replies;
            activity = Activity::Busy;
        }
        if (!replies.is_ready(now)) continue;
        ++counters_.reply_stall_cycles;
        if (activity == Activity::Waiting) activity = Activity::Blocked;
    }
    return activity;
}

Activity Dram::accept(Cycle now) {
    Activity activity = Activity::Waiting;
    while (requests_in->can_pop(now)) {
        const Target where = target(requests_in->front());
        if (channels_[where.channel].is_full()) {
            ++counters_.queue_full_cycles;
            return activity == Activity::Busy ? activity : Activity::Blocked;
        }
        const MemoryRequest request = requests_in->pop(now);
        channels_[where.channel].accept(request, where.place, now);
        ++(request.is_write ? counters_.writes : counters_.reads);
        (request.is_write ? counters_.write_bytes : counters_.read_bytes) += request.size_bytes;
        activity = Activity::Busy;
    }
    return activity;
}

bool Dram::issue(Cycle now) {
    bool has_issued = false;
    next_event_ = no_cycle;
    for (DramChannel& channel : channels_) {
        has_issued |= channel.issue(now, counters_);
        next_event_ = std::min(next_event_, channel.next_event());
    }
    return has_issued;
}

Dram::Target Dram::target(const MemoryRequest& request) const {
    const std::uint64_t block = request.address / interleave_bytes_;
    RTU_CHECK(
        request.size_bytes != 0 && (request.address + request.size_bytes - 1) / interleave_bytes_ == block,
        "{}: request of {} bytes at {} crosses a block of {}", name(), request.size_bytes, request.address,
        interleave_bytes_);
    const std::uint64_t block_in_channel = block / config_.channels;
    const std::uint64_t row_of_any_bank = block_in_channel / (config_.row_bytes / interleave_bytes_);
    return {.channel = std::size_t(block % config_.channels),
            .place = {.bank = std::uint32_t(row_of_any_bank % config_.banks),
                      .row = row_of_any_bank / config_.banks}};
}

}  // namespace rtu::sim
