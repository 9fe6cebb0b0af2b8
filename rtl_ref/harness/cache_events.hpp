#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace rtu::rtl {

/// What a Verilated cache did: its events_o (cache.sv), added up over cycles. The names are those of
/// sim::CacheCounters, which says what each one means.
struct CacheEvents {
    std::uint64_t hits = 0;
    std::uint64_t misses = 0;
    std::uint64_t mshr_merges = 0;
    std::uint64_t line_writes = 0;
    std::uint64_t evictions = 0;
    std::uint64_t write_backs = 0;
    std::uint64_t fills = 0;
    std::uint64_t bank_conflict_cycles = 0;
    std::uint64_t pipeline_full_cycles = 0;
    std::uint64_t target_full_cycles = 0;
    std::uint64_t mshr_full_cycles = 0;
    std::uint64_t below_full_cycles = 0;
    std::uint64_t write_back_stall_cycles = 0;
    std::uint64_t set_full_cycles = 0;
    std::uint64_t reply_stall_cycles = 0;

    /// Adds one cycle's events of a cache built with `banks` banks.
    void add(std::uint64_t events, std::uint32_t banks) {
        const auto next = [&events](std::uint32_t bits) {
            const std::uint64_t field = events & ((std::uint64_t(1) << bits) - 1);
            events >>= bits;
            return field;
        };
        for (std::uint64_t* counter :
             {&hits, &misses, &mshr_merges, &line_writes, &evictions, &write_backs, &fills}) {
            *counter += std::uint64_t(std::popcount(next(banks)));
        }
        const std::array<std::uint64_t*, 8> refusals{
            nullptr,           &bank_conflict_cycles, &pipeline_full_cycles,    &target_full_cycles,
            &mshr_full_cycles, &below_full_cycles,    &write_back_stall_cycles, &set_full_cycles};
        std::uint64_t* const refusal = refusals[next(3)];
        if (refusal != nullptr) ++*refusal;
        pipeline_full_cycles += next(1);
        reply_stall_cycles += std::uint64_t(std::popcount(next(3)));
    }
};

}  // namespace rtu::rtl
