#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cycle.hpp"

// What the units, ray slots, memory requests and channels of a machine do in some of its cycles.

namespace rtu::study {

/// The cycles that are looked at, [from, from + cycles).
struct TimelineWindow {
    sim::Cycle from = 0;
    sim::Cycle cycles = 2000;
    [[nodiscard]] sim::Cycle end() const { return from + cycles; }
};

/// As in sim::CycleAccount.
enum class UnitState : std::uint8_t { Idle, Starved, Blocked, Busy };
inline constexpr std::array<std::string_view, 4> unit_state_names{"idle", "starved", "blocked", "busy"};

/// A unit in one state. All spans are [begin, end), cut off at the window.
struct UnitSpan {
    std::uint32_t unit = 0;
    UnitState state = UnitState::Idle;
    sim::Cycle begin = 0, end = 0;
};

/// What a ray in a slot waits for, or is worked on by.
enum class SlotWait : std::uint8_t { Scheduler, NodeFetch, LeafFetch, StackFetch, BoxUnit, PairUnit };
inline constexpr std::array<std::string_view, 6> slot_wait_names{
    "scheduler", "memory: node", "memory: leaf", "memory: stack", "box unit", "pair unit"};

struct SlotSpan {
    std::uint32_t rtu = 0, slot = 0, ray = 0;
    SlotWait wait = SlotWait::Scheduler;
    sim::Cycle begin = 0, end = 0;
};

/// A ray in its slot, from the cycle that accepted it to the one that handed its hit out.
struct RaySpan {
    std::uint32_t rtu = 0, slot = 0, ray = 0;
    sim::Cycle begin = 0, end = 0;
};

/// A read, from the cycle that sent it to the one that sent its reply, or a write, which has no reply.
struct RequestSpan {
    enum class Kind : std::uint8_t { Node, Leaf, Stack, L1Miss };
    std::uint32_t rtu = 0;
    Kind kind = Kind::Node;
    bool is_write = false;
    std::optional<std::uint32_t> slot;  ///< none: of the L1
    std::uint64_t address = 0;
    std::uint32_t size_bytes = 0;
    sim::Cycle begin = 0, end = 0;  ///< a write's are equal
};
inline constexpr std::array<std::string_view, 4> request_names{"node", "leaf", "stack", "L1 miss"};

/// A channel in one cycle: only where something is not as in the cycle before.
struct ChannelSample {
    sim::Cycle cycle = 0;
    std::uint32_t channel = 0;
    std::uint32_t held = 0;  ///< items at the beginning of the cycle, all of them visible to the reader
    std::uint32_t pushed = 0, popped = 0;
};

struct TimelineChannel {
    std::string name;
    std::uint32_t depth = 0;
};

/// All of it. Spans are in the order of their ends, samples in that of their cycles.
struct Timeline {
    std::string scene, workload, version;
    std::uint32_t clock_mhz = 0;
    TimelineWindow window;
    sim::Cycle run_cycles = 0;       ///< of the whole run
    std::vector<std::string> units;  ///< names, like `rtu0.box`
    std::uint32_t rtu_count = 0, slots_per_rtu = 0;
    std::vector<TimelineChannel> channels;
    std::vector<UnitSpan> unit_spans;
    std::vector<RaySpan> ray_spans;
    std::vector<SlotSpan> slot_spans;
    std::vector<RequestSpan> requests;
    std::vector<ChannelSample> samples;
};

}  // namespace rtu::study
