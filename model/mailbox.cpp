#include "model/mailbox.hpp"

#include <algorithm>

namespace rtu::model {

MailboxAnswer Mailbox::look_up(NodeRef leaf) {
    const auto pair = std::uint32_t(leaf.address() / image_block_bytes);
    if (!has_shared_pairs_) {
        // Nothing can be found, so nothing need be kept.
        return MailboxAnswer::New;
    }
    const bool is_tested = std::ranges::find(tested_, pair) != tested_.end();
    if (!is_tested) tested_.push_back(pair);
    const bool is_known = options_.kind == MailboxKind::PerPair ? is_tested : finds_or_keeps(pair);
    if (is_known) return MailboxAnswer::Known;
    return is_tested ? MailboxAnswer::Again : MailboxAnswer::New;
}

bool Mailbox::finds_or_keeps(std::uint32_t pair) {
    if (options_.entries == 0) return false;
    return options_.kind == MailboxKind::Hashed ? finds_or_keeps_hashed(pair) : finds_or_keeps_recent(pair);
}

bool Mailbox::finds_or_keeps_recent(std::uint32_t pair) {
    const auto end = entries_.begin() + used_;
    if (std::find(entries_.begin(), end, pair) != end) return true;
    entries_[next_] = pair;
    next_ = (next_ + 1) % options_.entries;
    used_ = std::min(used_ + 1, options_.entries);
    return false;
}

bool Mailbox::finds_or_keeps_hashed(std::uint32_t pair) {
    const std::uint32_t place = pair % options_.entries;
    if (is_taken_[place] && entries_[place] == pair) return true;
    entries_[place] = pair;
    is_taken_[place] = true;
    return false;
}

}  // namespace rtu::model
