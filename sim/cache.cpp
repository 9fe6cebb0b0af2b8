#include "sim/cache.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "model/error.hpp"

namespace rtu::sim {
namespace {

std::uint32_t log2_of(std::uint32_t value) {
    RTU_CHECK(std::has_single_bit(value), "{} is not a power of two", value);
    return std::uint32_t(std::countr_zero(value));
}

}  // namespace

Cache::Cache(sc_core::sc_module_name name, ClockDomain& domain, const Config::Cache& config,
             std::size_t input_count, std::size_t reply_count, std::uint8_t source_below)
    : ClockedUnit(name, domain),
      requests_in("requests_in", input_count),
      replies_out("replies_out", reply_count),
      line_shift_(log2_of(config.line_bytes)),
      sector_shift_(log2_of(config.sector_bytes)),
      bank_mask_((1U << log2_of(config.banks)) - 1),
      source_below_(source_below),
      tags_(config),
      mshrs_(config.mshrs, config.targets_per_mshr, config.line_bytes / config.sector_bytes),
      inputs_(input_count),
      // A pipeline holds what all banks can put into it until the first reply leaves: full rate for one
      // client.
      outputs_(reply_count,
               {nullptr, {config.latency_cycles, std::size_t(config.latency_cycles) * config.banks}}) {
    RTU_CHECK(config.line_bytes / config.sector_bytes <= max_sectors_per_line, "more than {} sectors a line",
              max_sectors_per_line);
    RTU_CHECK(config.banks <= std::numeric_limits<std::uint64_t>::digits, "too many banks");
}

// The interfaces behind the ports never change; asking a port costs a call each time.
void Cache::end_of_elaboration() {
    for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i].channel = requests_in[i].operator->();
    for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i].channel = replies_out[i].operator->();
    below_ = below_out.operator->();
    fills_ = fills_in.operator->();
}

Cycle Cache::next_event(Cycle now) const {
    if (!write_backs_.is_empty()) return now + 1;
    Cycle next = no_cycle;
    for (const Output& output : outputs_) next = std::min(next, output.pipeline.ready_at());
    return std::max(next, now + 1);
}

std::string Cache::describe() const {
    std::size_t waiting = 0, replying = 0;
    for (const Input& input : inputs_) waiting += input.channel->size();
    for (const Output& output : outputs_) replying += output.pipeline.size();
    return fmt::format(
        "{} requests waiting, {} MSHRs in use for {} reads, {} write-backs, {} replies in the pipeline",
        waiting, mshrs_.size(), reads_.size(), write_backs_.size(), replying);
}

void Cache::check_drained() const {
    const CacheCounters& c = counters_;
    RTU_CHECK(c.reads == c.replies, "{}: {} reads but {} replies", name(), c.reads, c.replies);
    RTU_CHECK(c.line_reads == c.hits + c.misses + c.mshr_merges,
              "{}: {} line reads but {} hits + {} misses + {} merges", name(), c.line_reads, c.hits, c.misses,
              c.mshr_merges);
    RTU_CHECK(c.misses == c.fills, "{}: {} misses but {} fills", name(), c.misses, c.fills);
    RTU_CHECK(mshrs_.size() == 0 && reads_.size() == 0, "{}: not drained: {}", name(), describe());
}

Activity Cache::tick(Cycle now) {
    busy_banks_ = 0;
    has_moved_ = is_blocked_ = false;
    send_replies(now);
    if (!write_backs_.is_empty()) send_write_back(now);
    take_fills(now);
    accept(now);
    if (has_moved_) return Activity::Busy;
    return is_blocked_ ? Activity::Blocked : Activity::Waiting;
}

void Cache::send_replies(Cycle now) {
    for (Output& output : outputs_) {
        while (output.pipeline.is_ready(now)) {
            if (!output.channel->can_push(now)) {
                ++counters_.reply_stall_cycles;
                is_blocked_ = true;
                break;
            }
            output.channel->push(now, output.pipeline.pop());
            ++counters_.replies;
            has_moved_ = true;
        }
    }
}

void Cache::send_write_back(Cycle now) {
    if (!below_->can_push(now)) {
        is_blocked_ = true;
        return;
    }
    const WriteBackBuffer::Run run = write_backs_.pop_run();
    const std::uint32_t bytes = run.sector_count << sector_shift_;
    below_->push(now, {.address = (std::uint64_t(run.line_number) << line_shift_) +
                                  (std::uint64_t(run.first_sector) << sector_shift_),
                       .size_bytes = bytes,
                       .tag = 0,
                       .source = source_below_,
                       .is_write = true});
    counters_.bytes_to_below += bytes;
    has_moved_ = true;
}

void Cache::take_fills(Cycle now) {
    while (fills_->can_pop(now)) {
        if (!take_fill(now, mshrs_.fetch(fills_->front().tag))) return;
        fills_->pop(now);
    }
}

// Answers one waiting access with the fill at the head of its channel; true when it was the last one.
bool Cache::take_fill(Cycle now, const Mshrs::Fetch& fetch) {
    const std::uint32_t entry = mshrs_.entry(fetch.mshr);
    const std::uint64_t bank = bank_bit(tags_.line_number(entry));
    if ((busy_banks_ & bank) != 0) return false;
    CacheTags::Line& line = tags_[entry];
    const SectorMask arrived = line.valid | fetch.sectors;
    if (const auto index = mshrs_.satisfied_target(fetch.mshr, arrived)) {
        const std::uint32_t read = mshrs_.target(fetch.mshr, *index).read;
        if (reads_[read].parts_left == 1 && outputs_[reads_[read].source].pipeline.is_full()) {
            ++counters_.pipeline_full_cycles;
            is_blocked_ = true;
            return false;
        }
        finish_part(now, read);
        mshrs_.remove_target(fetch.mshr, *index);
    }
    busy_banks_ |= bank;
    has_moved_ = true;
    if (mshrs_.satisfied_target(fetch.mshr, arrived)) return false;
    line.valid = arrived;
    line.pending &= ~fetch.sectors;
    if (line.pending == 0) {
        RTU_CHECK(!mshrs_.has_targets(fetch.mshr), "{}: a line has arrived but a read still waits", name());
        mshrs_.close(fetch.mshr);
    }
    ++counters_.fills;
    return true;
}

}  // namespace rtu::sim
