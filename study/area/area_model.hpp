#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/config.hpp"
#include "study/area/gate_counts.hpp"

// What a machine is made of: counted units of the RTL reference, and formulas for what grows with the
// configuration. Every formula is in docs/area.md.

namespace rtu::study {

/// A kind of circuit in an RTU.
struct AreaPart {
    std::string unit;  ///< whose it is: "box", "pair", "scheduler", "queues" or "l1"
    std::string name;
    double copies = 1;
    GateCounts each;
    double sram_bits_each = 0;  ///< in arrays of memory cells, in no gate count
    bool is_counted = false;    ///< synthesised as it is; else a formula
    std::string how;            ///< the counted row or the formula

    [[nodiscard]] GateCounts gates() const { return times(copies, each); }
    [[nodiscard]] double sram_bits() const { return copies * sram_bits_each; }
};

struct AreaTotal {
    GateCounts gates;
    double sram_bits = 0;
};

[[nodiscard]] AreaTotal total(std::span<const AreaPart> parts);

/// A box unit of `lanes` for nodes of `width` children.
[[nodiscard]] std::vector<AreaPart> box_area(std::uint32_t lanes, std::uint32_t width);

/// What makes binary32 planes of quantised ones, for each of the 6 planes of a lane: an adder, and what
/// normalises 8 bits. Assumed, not synthesised.
[[nodiscard]] AreaPart dequantiser_area(std::uint32_t lanes);

/// What one more child adds to a box tester, and what its lanes share: of a tester of W children, without
/// near_to_far. From the counts of 2 and 8 children.
[[nodiscard]] GateCounts box_lane_area();
[[nodiscard]] GateCounts box_common_area();

/// A pair unit: `testers` first passes and the hit units behind them.
[[nodiscard]] std::vector<AreaPart> pair_area(const sim::Config::Rtu::Pair& pair);

/// A queue of sim/fifo.hpp in registers, as rtl_ref/fp/stream_fifo.sv.
[[nodiscard]] GateCounts queue_area(std::uint32_t depth, std::uint32_t width_bits);

/// A queue that takes up to `push` items and gives up to `pop` a cycle.
struct QueueShape {
    std::uint32_t depth = 0;
    std::uint32_t width_bits = 0;
    std::uint32_t push = 1;
    std::uint32_t pop = 1;
};

/// Such a queue in registers, as rtl_ref/rtu/multi_fifo.sv; with `shows_next` it also tells what it will give
/// in the next cycle.
[[nodiscard]] GateCounts multi_queue_area(const QueueShape& shape, bool shows_next);

/// The list of free slots, as rtl_ref/rtu/free_slots.sv.
[[nodiscard]] GateCounts free_slots_area(std::uint32_t slots);

/// One RTU with its L1.
[[nodiscard]] std::vector<AreaPart> rtu_area(const sim::Config& config);

/// Bits of an address in the RTU.
inline constexpr std::uint32_t address_bits = 32;

/// Picoseconds that a clock leaves for each gate of a path that deep, with its share of wires and registers;
/// 0 for a depth of 0.
[[nodiscard]] double ps_per_gate(double depth, std::uint32_t clock_mhz);

}  // namespace rtu::study
