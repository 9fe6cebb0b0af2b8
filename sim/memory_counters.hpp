#pragma once

#include <array>
#include <cstdint>

#include "sim/counter_table.hpp"

namespace rtu::sim {

/// What a cache did. Reads: line_reads = hits + misses + mshr_merges, and reads = replies once it has
/// drained. A stall counter counts input heads: one for every input and cycle in which the head had to wait
/// for that reason.
struct CacheCounters {
    std::uint64_t reads = 0;
    std::uint64_t replies = 0;
    std::uint64_t line_reads = 0;
    std::uint64_t hits = 0;
    std::uint64_t misses = 0;
    std::uint64_t mshr_merges = 0;
    std::uint64_t line_writes = 0;
    std::uint64_t evictions = 0;
    std::uint64_t write_backs = 0;
    std::uint64_t fills = 0;
    std::uint64_t bytes_read = 0;
    std::uint64_t bytes_written = 0;
    std::uint64_t bytes_from_below = 0;
    std::uint64_t bytes_to_below = 0;
    std::uint64_t bank_conflict_cycles = 0;
    std::uint64_t reply_stall_cycles = 0;
    std::uint64_t pipeline_full_cycles = 0;
    std::uint64_t mshr_full_cycles = 0;
    std::uint64_t target_full_cycles = 0;
    std::uint64_t set_full_cycles = 0;
    std::uint64_t write_back_stall_cycles = 0;
    std::uint64_t below_full_cycles = 0;
    friend bool operator==(const CacheCounters&, const CacheCounters&) = default;
};

inline constexpr std::array cache_counter_rows = std::to_array<CounterRow<CacheCounters>>({
    {"reads", "requests", "read requests accepted", &CacheCounters::reads},
    {"replies", "replies", "replies sent", &CacheCounters::replies},
    {"line_reads", "accesses", "line accesses of reads: one for every line that a read touches",
     &CacheCounters::line_reads},
    {"hits", "accesses", "line reads that found all their sectors", &CacheCounters::hits},
    {"misses", "accesses", "line reads that sent a request below", &CacheCounters::misses},
    {"mshr_merges", "accesses", "line reads whose missing sectors were all on their way already",
     &CacheCounters::mshr_merges},
    {"line_writes", "accesses", "line accesses of writes", &CacheCounters::line_writes},
    {"evictions", "lines", "lines replaced", &CacheCounters::evictions},
    {"write_backs", "lines", "lines replaced that had dirty sectors", &CacheCounters::write_backs},
    {"fills", "replies", "replies received from below", &CacheCounters::fills},
    {"bytes_read", "bytes", "asked for by reads", &CacheCounters::bytes_read},
    {"bytes_written", "bytes", "carried by writes", &CacheCounters::bytes_written},
    {"bytes_from_below", "bytes", "requested from below", &CacheCounters::bytes_from_below},
    {"bytes_to_below", "bytes", "written back", &CacheCounters::bytes_to_below},
    {"bank_conflict_cycles", "cycles", "an input waited for a bank in use",
     &CacheCounters::bank_conflict_cycles},
    {"reply_stall_cycles", "cycles", "a reply waited for its full channel",
     &CacheCounters::reply_stall_cycles},
    {"pipeline_full_cycles", "cycles", "an input or a fill waited behind such replies",
     &CacheCounters::pipeline_full_cycles},
    {"mshr_full_cycles", "cycles", "an input waited for an MSHR", &CacheCounters::mshr_full_cycles},
    {"target_full_cycles", "cycles", "an input waited for a target entry of its line's MSHR",
     &CacheCounters::target_full_cycles},
    {"set_full_cycles", "cycles", "an input waited because every way of the set had a fill on its way",
     &CacheCounters::set_full_cycles},
    {"write_back_stall_cycles", "cycles", "an input waited for a write-back to leave",
     &CacheCounters::write_back_stall_cycles},
    {"below_full_cycles", "cycles", "an input waited for the request channel below",
     &CacheCounters::below_full_cycles},
});
static_assert(has_row_for_every_field(cache_counter_rows));

/// What the DRAM did: row_hits + row_misses + row_conflicts = reads + writes once it has drained.
struct DramCounters {
    std::uint64_t reads = 0;
    std::uint64_t writes = 0;
    std::uint64_t replies = 0;
    std::uint64_t read_bytes = 0;
    std::uint64_t write_bytes = 0;
    std::uint64_t row_hits = 0;
    std::uint64_t row_misses = 0;
    std::uint64_t row_conflicts = 0;
    std::uint64_t bus_busy_cycles = 0;
    std::uint64_t queue_full_cycles = 0;
    std::uint64_t reply_stall_cycles = 0;
    friend bool operator==(const DramCounters&, const DramCounters&) = default;
};

inline constexpr std::array dram_counter_rows = std::to_array<CounterRow<DramCounters>>({
    {"reads", "requests", "reads accepted", &DramCounters::reads},
    {"writes", "requests", "writes accepted", &DramCounters::writes},
    {"replies", "replies", "replies sent", &DramCounters::replies},
    {"read_bytes", "bytes", "asked for by reads", &DramCounters::read_bytes},
    {"write_bytes", "bytes", "carried by writes", &DramCounters::write_bytes},
    {"row_hits", "requests", "found their row open", &DramCounters::row_hits},
    {"row_misses", "requests", "found their bank closed and opened the row", &DramCounters::row_misses},
    {"row_conflicts", "requests", "closed another row first", &DramCounters::row_conflicts},
    {"bus_busy_cycles", "cycles", "data on the bus, all channels together", &DramCounters::bus_busy_cycles},
    {"queue_full_cycles", "cycles", "the input waited for its channel's queue",
     &DramCounters::queue_full_cycles},
    {"reply_stall_cycles", "cycles", "a channel's reply waited for the reply channel",
     &DramCounters::reply_stall_cycles},
});
static_assert(has_row_for_every_field(dram_counter_rows));

/// What a flat memory did.
struct FlatMemoryCounters {
    std::uint64_t reads = 0;
    std::uint64_t writes = 0;
    std::uint64_t replies = 0;
    std::uint64_t read_bytes = 0;
    std::uint64_t write_bytes = 0;
    std::uint64_t bus_busy_cycles = 0;
    std::uint64_t reply_stall_cycles = 0;
    friend bool operator==(const FlatMemoryCounters&, const FlatMemoryCounters&) = default;
};

inline constexpr std::array flat_memory_counter_rows = std::to_array<CounterRow<FlatMemoryCounters>>({
    {"reads", "requests", "reads accepted", &FlatMemoryCounters::reads},
    {"writes", "requests", "writes accepted", &FlatMemoryCounters::writes},
    {"replies", "replies", "replies sent", &FlatMemoryCounters::replies},
    {"read_bytes", "bytes", "asked for by reads", &FlatMemoryCounters::read_bytes},
    {"write_bytes", "bytes", "carried by writes", &FlatMemoryCounters::write_bytes},
    {"bus_busy_cycles", "cycles", "data on the bus", &FlatMemoryCounters::bus_busy_cycles},
    {"reply_stall_cycles", "cycles", "a reply waited for its full channel",
     &FlatMemoryCounters::reply_stall_cycles},
});
static_assert(has_row_for_every_field(flat_memory_counter_rows));

}  // namespace rtu::sim
