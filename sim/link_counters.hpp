#pragma once

#include <array>
#include <cstdint>

#include "sim/counter_table.hpp"

namespace rtu::sim {

/// What a link moved; whatever was accepted has arrived once it has drained.
struct LinkCounters {
    std::uint64_t up_transfers = 0;
    std::uint64_t down_transfers = 0;
    std::uint64_t up_bytes = 0;
    std::uint64_t down_bytes = 0;
    std::uint64_t up_bytes_arrived = 0;
    std::uint64_t down_bytes_arrived = 0;
    std::uint64_t overhead_cycles = 0;
    std::uint64_t outstanding_full_cycles = 0;
    friend bool operator==(const LinkCounters&, const LinkCounters&) = default;
};

inline constexpr std::array link_counter_rows = std::to_array<CounterRow<LinkCounters>>({
    {"up_transfers", "transfers", "accepted from the host", &LinkCounters::up_transfers},
    {"down_transfers", "transfers", "read-backs accepted from the host", &LinkCounters::down_transfers},
    {"up_bytes", "bytes", "in the transfers up", &LinkCounters::up_bytes},
    {"down_bytes", "bytes", "in the transfers down", &LinkCounters::down_bytes},
    {"up_bytes_arrived", "bytes", "of those, in the machine", &LinkCounters::up_bytes_arrived},
    {"down_bytes_arrived", "bytes", "of those, in the host", &LinkCounters::down_bytes_arrived},
    {"overhead_cycles", "cycles", "that the host spent on transfers", &LinkCounters::overhead_cycles},
    {"outstanding_full_cycles", "cycles", "a transfer waited because too many were under way",
     &LinkCounters::outstanding_full_cycles},
});
static_assert(has_row_for_every_field(link_counter_rows));

/// Where the time of a run with a link went: every cycle is one of four.
struct LinkTime {
    std::uint64_t machine_cycles = 0;
    std::uint64_t read_back_cycles = 0;
    std::uint64_t upload_cycles = 0;
    std::uint64_t waiting_cycles = 0;
    [[nodiscard]] std::uint64_t total() const {
        return machine_cycles + read_back_cycles + upload_cycles + waiting_cycles;
    }
    friend bool operator==(const LinkTime&, const LinkTime&) = default;
};

inline constexpr std::array link_time_rows = std::to_array<CounterRow<LinkTime>>({
    {"machine_cycles", "cycles", "a batch was in the machine", &LinkTime::machine_cycles},
    {"read_back_cycles", "cycles", "none was, but results were on their way down",
     &LinkTime::read_back_cycles},
    {"upload_cycles", "cycles", "neither, but a batch was on its way up", &LinkTime::upload_cycles},
    {"waiting_cycles", "cycles", "none of these", &LinkTime::waiting_cycles},
});
static_assert(has_row_for_every_field(link_time_rows));

}  // namespace rtu::sim
