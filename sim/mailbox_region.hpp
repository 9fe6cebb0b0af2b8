#pragma once

#include <cstdint>

#include "model/memory_image.hpp"

namespace rtu::sim {

/// A word of a mailbox in memory.
inline constexpr std::uint32_t mailbox_word_bytes = 4;

/// Where the mailboxes of `rtu.mailbox.kind` = per_pair lie: for each ray slot a word for every pair, so that
/// rays under way at the same time have nothing in common. The word of a slot holds the number of the last
/// ray of the slot that was tested with the pair.
struct MailboxRegion {
    std::uint64_t base_address = 0;
    std::uint64_t slot_bytes = 0;
    std::uint64_t first_leaf = 0;  ///< address of the image's first leaf

    [[nodiscard]] std::uint64_t word_address(std::uint32_t slot, model::NodeRef leaf) const {
        const std::uint64_t pair = (leaf.address() - first_leaf) / model::image_block_bytes;
        return base_address + slot * slot_bytes + pair * mailbox_word_bytes;
    }
};

}  // namespace rtu::sim
