#pragma once

#include <algorithm>
#include <cstdint>

#include "model/memory_image.hpp"
#include "model/traversal.hpp"

namespace rtu::model {

/// Entries of a ray's stack that are written to memory or read back together, at most: four of 8 bytes.
inline constexpr std::uint32_t spill_block_entries = 4;
/// What a block takes in memory, whatever the number of its entries: it starts on a sector of its own.
inline constexpr std::uint32_t spill_block_bytes = 32;

/// Entries of a block when `stack_entries` of a ray's stack (1 or more) fit on chip.
[[nodiscard]] inline std::uint32_t spill_block_size(std::uint32_t stack_entries) {
    return std::min(spill_block_entries, stack_entries);
}

/// Where the stacks of a machine's ray slots spill to: behind the image, one run of blocks a slot. Block i of
/// a slot lies at `base_address + slot * slot_bytes + i * spill_block_bytes`; an entry is its t_near, then
/// its NodeRef, the lowest entry first.
struct StackRegion {
    std::uint64_t base_address = 0;
    std::uint64_t slot_bytes = 0;
};

/// Room for the deepest stack that the image can cause, in whole lines of `line_bytes` a slot; it begins on a
/// page.
[[nodiscard]] inline StackRegion stack_region(const MemoryImage& image, std::uint32_t stack_entries,
                                              std::uint32_t line_bytes) {
    const auto in_whole = [](std::uint64_t value, std::uint64_t unit) { return (value + unit - 1) / unit; };
    constexpr std::uint64_t page_bytes = 4096;
    const std::uint64_t blocks =
        in_whole(stack_capacity(image) + spill_block_entries, spill_block_size(stack_entries));
    return {in_whole(image.size_bytes(), page_bytes) * page_bytes,
            in_whole(blocks * spill_block_bytes, line_bytes) * line_bytes};
}

}  // namespace rtu::model
