#pragma once

#include <array>
#include <cstdint>

#include "sim/counter_table.hpp"

namespace rtu::sim {

struct SchedulerCounters {
    std::uint64_t rays_accepted = 0;
    std::uint64_t rays_finished = 0;
    std::uint64_t node_fetches = 0;
    std::uint64_t leaf_fetches = 0;
    std::uint64_t spilled_entries = 0;
    std::uint64_t reloaded_entries = 0;
    std::uint64_t slot_cycles = 0;
    friend bool operator==(const SchedulerCounters&, const SchedulerCounters&) = default;
};

inline constexpr std::array scheduler_counter_rows = std::to_array<CounterRow<SchedulerCounters>>({
    {"rays_accepted", "rays", "rays that got a slot", &SchedulerCounters::rays_accepted},
    {"rays_finished", "rays", "rays whose hit was returned", &SchedulerCounters::rays_finished},
    {"node_fetches", "requests", "inner nodes asked for", &SchedulerCounters::node_fetches},
    {"leaf_fetches", "requests", "leaves asked for", &SchedulerCounters::leaf_fetches},
    {"spilled_entries", "entries", "stack entries written to memory", &SchedulerCounters::spilled_entries},
    {"reloaded_entries", "entries", "stack entries read back", &SchedulerCounters::reloaded_entries},
    {"slot_cycles", "cycles", "cycles that slots were held, over all slots", &SchedulerCounters::slot_cycles},
});
static_assert(has_row_for_every_field(scheduler_counter_rows));

/// Of the scheduler, where the tree has spatial splits or the machine a mailbox.
struct MailboxCounters {
    std::uint64_t lookups = 0;
    std::uint64_t hits = 0;
    std::uint64_t duplicates = 0;
    std::uint64_t bytes_saved = 0;
    std::uint64_t bytes_read = 0;
    std::uint64_t bytes_written = 0;
    friend bool operator==(const MailboxCounters&, const MailboxCounters&) = default;
};

inline constexpr std::array mailbox_counter_rows = std::to_array<CounterRow<MailboxCounters>>({
    {"mailbox_lookups", "leaves", "leaves that a mailbox was asked for", &MailboxCounters::lookups},
    {"mailbox_hits", "leaves", "of them, neither fetched nor tested: their pair was known",
     &MailboxCounters::hits},
    {"duplicate_tests", "tests", "pair tests of a pair that its ray had been tested with before",
     &MailboxCounters::duplicates},
    {"mailbox_bytes_saved", "bytes", "of leaves that were not fetched", &MailboxCounters::bytes_saved},
    {"mailbox_bytes_read", "bytes", "of a mailbox in memory, read", &MailboxCounters::bytes_read},
    {"mailbox_bytes_written", "bytes", "of a mailbox in memory, written", &MailboxCounters::bytes_written},
});
static_assert(has_row_for_every_field(mailbox_counter_rows));

struct BoxCounters {
    std::uint64_t node_visits = 0;
    std::uint64_t box_tests = 0;
    std::uint64_t issue_cycles = 0;
    friend bool operator==(const BoxCounters&, const BoxCounters&) = default;
};

inline constexpr std::array box_counter_rows = std::to_array<CounterRow<BoxCounters>>({
    {"node_visits", "nodes", "inner nodes tested", &BoxCounters::node_visits},
    {"box_tests", "tests", "ray-box tests, one per child", &BoxCounters::box_tests},
    {"issue_cycles", "cycles", "cycles in which at least one lane was used", &BoxCounters::issue_cycles},
});
static_assert(has_row_for_every_field(box_counter_rows));

struct PairCounters {
    std::uint64_t leaf_visits = 0;
    std::uint64_t pair_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t exact_tests = 0;
    std::uint64_t replays = 0;
    std::uint64_t tester_cycles = 0;
    std::uint64_t standing_cycles = 0;
    std::uint64_t survivors = 0;
    std::uint64_t hit_unit_cycles = 0;
    std::uint64_t hit_wait_cycles = 0;
    friend bool operator==(const PairCounters&, const PairCounters&) = default;
};

inline constexpr std::array pair_counter_rows = std::to_array<CounterRow<PairCounters>>({
    {"leaf_visits", "leaves", "leaves tested", &PairCounters::leaf_visits},
    {"pair_tests", "tests", "pairs and lone triangles tested", &PairCounters::pair_tests},
    {"triangle_tests", "tests", "triangles in them", &PairCounters::triangle_tests},
    {"exact_tests", "tests", "of those, left to the exact pass", &PairCounters::exact_tests},
    {"replays", "replays", "pairs with two exact tests and one unit for them", &PairCounters::replays},
    {"tester_cycles", "cycles", "cycles that testers were held, over all testers",
     &PairCounters::tester_cycles},
    {"standing_cycles", "cycles", "cycles that first passes stood still, over all testers",
     &PairCounters::standing_cycles},
    {"survivors", "leaves", "leaves that hit units were given", &PairCounters::survivors},
    {"hit_unit_cycles", "cycles", "cycles that hit units were held, over all hit units",
     &PairCounters::hit_unit_cycles},
    {"hit_wait_cycles", "cycles", "cycles that survivors waited for a hit unit, over all survivors",
     &PairCounters::hit_wait_cycles},
});
static_assert(has_row_for_every_field(pair_counter_rows));

}  // namespace rtu::sim
