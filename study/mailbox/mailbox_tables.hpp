#pragma once

#include <string>

#include "study/mailbox/mailbox_study.hpp"

namespace rtu::study {

/// What each pairing and splits are worth with and without the other, a row a kind of rays. Empty with one
/// pairing only. This and all below: text with a heading, for people.
[[nodiscard]] std::string tree_worth_table(const MailboxReport& report);

/// Leaves added, bytes and MRPS of each tree with and without splits.
[[nodiscard]] std::string tree_table(const MailboxReport& report);

/// MRPS of each tree with splits, a column a mailbox.
[[nodiscard]] std::string mailbox_mrps_table(const MailboxReport& report);

/// What each mailbox finds, takes and changes.
[[nodiscard]] std::string mailbox_cost_table(const MailboxReport& report);

}  // namespace rtu::study
