#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/memory_image.hpp"

namespace rtu::model {

/// Where a ray remembers which pairs it has been tested with.
enum class MailboxKind : std::uint8_t {
    Recent,   ///< the pairs tested last, all compared at once [SSK07]
    Hashed,   ///< one place a pair, of several pairs each: the pair's number modulo the places [Wal04]
    PerPair,  ///< a word a pair in memory: all of them
};

inline constexpr std::uint32_t max_mailbox_entries = 16;

struct MailboxOptions {
    MailboxKind kind = MailboxKind::Recent;
    std::uint32_t entries = 0;  ///< 0..16; hashed: a power of two; 0 is no mailbox, but for PerPair

    [[nodiscard]] bool is_on() const { return kind == MailboxKind::PerPair || entries > 0; }
    friend bool operator==(const MailboxOptions&, const MailboxOptions&) = default;
};

/// What a mailbox says of a leaf that its ray has come to.
enum class MailboxAnswer : std::uint8_t {
    New,    ///< never tested: fetch and test it
    Again,  ///< tested before, and forgotten, or there is no mailbox: fetch and test it
    Known,  ///< tested before: neither
};

/// The mailbox of one ray. Spatial splits bring a ray to one pair several times; only the first test can
/// change its hit, because t_end never grows. So a leaf whose pair is known is passed over, before it is
/// fetched, and the hit is the same to the bit.
///
/// The contract, for the timing model and the RTL alike. When a ray's stack has been popped and the entry
/// that still matters is a leaf, its pair is looked up, once. `Recent`: the number is compared with all
/// entries at once. Found: the entries stay as they are. Not found: the number goes in, in the place of the
/// one that went in first (first in, first out; a hit does not move an entry). `Hashed`: it is compared with
/// the one entry number % entries, and takes its place when it differs. `PerPair`: the pair's word is read,
/// and written when it does not hold the ray. A ray begins with every entry empty. A pair's number is its
/// leaf's address / 64, which only leaves of one pair share.
class Mailbox {
  public:
    Mailbox() = default;
    explicit Mailbox(MailboxOptions options) : options_(options) {}

    /// Forgets everything, for a new ray in a tree of which `has_shared_pairs` says whether it can come to a
    /// pair twice; only then New and Again are told apart.
    void clear(bool has_shared_pairs) {
        used_ = next_ = 0;
        is_taken_ = {};
        has_shared_pairs_ = has_shared_pairs;
        tested_.clear();
    }
    /// Looks up the pair of a leaf; unless it is known, the mailbox takes it that the pair is tested now.
    [[nodiscard]] MailboxAnswer look_up(NodeRef leaf);
    [[nodiscard]] const MailboxOptions& options() const { return options_; }

  private:
    [[nodiscard]] bool finds_or_keeps(std::uint32_t pair);
    [[nodiscard]] bool finds_or_keeps_recent(std::uint32_t pair);
    [[nodiscard]] bool finds_or_keeps_hashed(std::uint32_t pair);

    MailboxOptions options_;
    std::array<std::uint32_t, max_mailbox_entries> entries_{};
    std::array<bool, max_mailbox_entries> is_taken_{};
    std::uint32_t used_ = 0, next_ = 0;  // of Recent
    bool has_shared_pairs_ = true;
    std::vector<std::uint32_t> tested_;  // each once
};

}  // namespace rtu::model
