// The input end of the cache: how line accesses are accepted or refused.
#include <bit>
#include <limits>

#include "model/error.hpp"
#include "sim/cache.hpp"

namespace rtu::sim {
namespace {

// Sectors first to last, both included.
SectorMask sector_range(std::uint32_t first, std::uint32_t last) {
    return ((SectorMask(2) << last) - 1) & ~((SectorMask(1) << first) - 1);
}

}  // namespace

void Cache::accept(Cycle now) {
    if (inputs_.size() == 1) return accept_from(now, inputs_[0]);
    const std::size_t first = now % inputs_.size();
    for (std::size_t i = first; i < inputs_.size(); ++i) accept_from(now, inputs_[i]);
    for (std::size_t i = 0; i < first; ++i) accept_from(now, inputs_[i]);
}

void Cache::accept_from(Cycle now, Input& input) {
    while (input.channel->can_pop(now)) {
        const MemoryRequest& request = input.channel->front();
        const LineAccess access = next_access(input, request);
        Refusal refusal = &CacheCounters::bank_conflict_cycles;
        if ((busy_banks_ & bank_bit(access.line_number)) == 0) {
            refusal = request.is_write ? write_line(access) : read_line(now, input, request, access);
        }
        if (refusal != nullptr) {
            ++(counters_.*refusal);
            is_blocked_ = true;
            return;
        }
        busy_banks_ |= bank_bit(access.line_number);
        has_moved_ = true;
        if (++input.lines_done == access.line_count) {
            input.lines_done = 0;
            if (!request.is_write) ++counters_.reads;
            (request.is_write ? counters_.bytes_written : counters_.bytes_read) += request.size_bytes;
            input.channel->pop(now);
        }
    }
}

Cache::LineAccess Cache::next_access(const Input& input, const MemoryRequest& request) const {
    const std::uint64_t last_byte = request.address + request.size_bytes - 1;
    const std::uint64_t first_line = request.address >> line_shift_, last_line = last_byte >> line_shift_;
    RTU_CHECK(request.size_bytes != 0 && request.source < outputs_.size() &&
                  last_line < std::numeric_limits<std::uint32_t>::max(),
              "{}: request of {} bytes at {} from source {}", name(), request.size_bytes, request.address,
              request.source);
    const std::uint64_t line = first_line + input.lines_done;
    const std::uint64_t in_line = (std::uint64_t(1) << line_shift_) - 1;
    const std::uint64_t first_byte_in_line = line == first_line ? request.address & in_line : 0;
    const std::uint64_t last_byte_in_line = line == last_line ? last_byte & in_line : in_line;
    return {std::uint32_t(line), std::uint32_t(last_line - first_line + 1),
            sector_range(std::uint32_t(first_byte_in_line >> sector_shift_),
                         std::uint32_t(last_byte_in_line >> sector_shift_))};
}

Cache::Refusal Cache::read_line(Cycle now, Input& input, const MemoryRequest& request,
                                const LineAccess& access) {
    Pipeline<MemoryReply>& pipeline = outputs_[request.source].pipeline;
    if (pipeline.is_full()) return &CacheCounters::pipeline_full_cycles;
    const std::optional<std::uint32_t> entry = tags_.find(access.line_number);
    const bool is_hit = entry && (access.sectors & ~tags_[*entry].valid) == 0;
    if (!is_hit) return miss_line(now, input, request, access, entry);
    tags_.touch(*entry);
    ++counters_.line_reads;
    ++counters_.hits;
    if (access.line_count == 1) {
        pipeline.push(now, {request.address, request.tag});
    } else {
        finish_part(now, pending_read(input, request, access));
    }
    return nullptr;
}

// Every resource is asked for before the first one is taken: a refused access must leave no trace.
Cache::Refusal Cache::miss_line(Cycle now, Input& input, const MemoryRequest& request,
                                const LineAccess& access, std::optional<std::uint32_t> entry) {
    SectorMask missing = access.sectors;
    bool has_mshr = false;
    if (entry) {
        const CacheTags::Line& line = tags_[*entry];
        missing &= ~(line.valid | line.pending);
        has_mshr = line.pending != 0;
        if (has_mshr && !mshrs_.can_add_target(line.mshr)) return &CacheCounters::target_full_cycles;
    }
    if (!has_mshr && mshrs_.is_full()) return &CacheCounters::mshr_full_cycles;
    if (missing != 0 && !below_->can_push(now)) return &CacheCounters::below_full_cycles;
    if (missing != 0 && write_backs_.holds(access.line_number))
        return &CacheCounters::write_back_stall_cycles;
    if (!entry) {
        const Allocation allocation = allocate(access.line_number);
        if (allocation.refusal != nullptr) return allocation.refusal;
        entry = allocation.entry;
    }
    if (!has_mshr) tags_[*entry].mshr = mshrs_.open(*entry);
    mshrs_.add_target(tags_[*entry].mshr, {pending_read(input, request, access), access.sectors});
    tags_.touch(*entry);
    ++counters_.line_reads;
    ++(missing != 0 ? counters_.misses : counters_.mshr_merges);
    if (missing != 0) fetch(now, *entry, missing);
    return nullptr;
}

void Cache::fetch(Cycle now, std::uint32_t entry, SectorMask sectors) {
    CacheTags::Line& line = tags_[entry];
    line.pending |= sectors;
    const auto first = std::uint32_t(std::countr_zero(sectors));
    const std::uint32_t bytes = std::uint32_t(std::bit_width(sectors) - int(first)) << sector_shift_;
    below_->push(now, {.address = (std::uint64_t(tags_.line_number(entry)) << line_shift_) +
                                  (std::uint64_t(first) << sector_shift_),
                       .size_bytes = bytes,
                       .tag = mshrs_.note_fetch(line.mshr, sectors),
                       .source = source_below_,
                       .is_write = false});
    counters_.bytes_from_below += bytes;
}

Cache::Refusal Cache::write_line(const LineAccess& access) {
    std::optional<std::uint32_t> entry = tags_.find(access.line_number);
    if (!entry) {
        const Allocation allocation = allocate(access.line_number);
        if (allocation.refusal != nullptr) return allocation.refusal;
        entry = allocation.entry;
    }
    tags_[*entry].valid |= access.sectors;
    tags_[*entry].dirty |= access.sectors;
    tags_.touch(*entry);
    ++counters_.line_writes;
    return nullptr;
}

// The sectors that were not there, nor on their way.
SectorMask Cache::warm_line(std::uint32_t line_number, std::uint32_t first_sector,
                            std::uint32_t last_sector) {
    const SectorMask wanted = sector_range(first_sector, last_sector);
    std::optional<std::uint32_t> entry = tags_.find(line_number);
    if (!entry) {
        entry = tags_.victim(line_number);
        if (!entry) return wanted;  // every way waits for a fill
        tags_.replace(*entry, line_number);
    }
    CacheTags::Line& line = tags_[*entry];
    const SectorMask absent = wanted & ~(line.valid | line.pending);
    line.valid |= absent;
    tags_.touch(*entry);
    return absent;
}

Cache::Allocation Cache::allocate(std::uint32_t line_number) {
    const std::optional<std::uint32_t> victim = tags_.victim(line_number);
    if (!victim) return {.refusal = &CacheCounters::set_full_cycles};
    const CacheTags::Line& old = tags_[*victim];
    if (old.dirty != 0) {
        if (write_backs_.is_full()) return {.refusal = &CacheCounters::write_back_stall_cycles};
        write_backs_.push(tags_.line_number(*victim), old.dirty);
        ++counters_.write_backs;
    }
    if (old.valid != 0) ++counters_.evictions;
    tags_.replace(*victim, line_number);
    return {.entry = *victim};
}

// The read that the access belongs to; a read of several lines keeps it from its first line on.
std::uint32_t Cache::pending_read(Input& input, const MemoryRequest& request, const LineAccess& access) {
    if (input.lines_done == 0) {
        input.read = reads_.open({{request.address, request.tag}, request.source, access.line_count});
    }
    return input.read;
}

void Cache::finish_part(Cycle now, std::uint32_t read) {
    PendingReads::Read& pending = reads_[read];
    if (--pending.parts_left != 0) return;
    outputs_[pending.source].pipeline.push(now, pending.reply);
    reads_.close(read);
}

}  // namespace rtu::sim
