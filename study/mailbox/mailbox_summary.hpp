#pragma once

#include <string>
#include <vector>

#include "study/mailbox/mailbox_study.hpp"

namespace rtu::study {

/// The values of a column in the order in which they first come.
[[nodiscard]] std::vector<std::string> values_of(const MailboxReport& report,
                                                 std::string MailboxRow::*column);

/// MRPS of all workloads of a scene together: their rays over their cycles. 0 without such rows.
[[nodiscard]] double total_mrps(const MailboxReport& report, const std::string& scene,
                                const std::string& pairing, sim::SplitKind splits,
                                const model::MailboxOptions& mailbox);

/// What splits, pairing and mailbox are worth in one scene, in MRPS of all its workloads; percent.
struct MailboxWorth {
    std::string best_pairing;       ///< the one of most MRPS without spatial splits
    model::MailboxOptions mailbox;  ///< of the last pairs, with which best_pairing and splits give most MRPS
    double pairing_alone = 0;       ///< the best pairing against the first, object splits
    double splits_alone = 0;        ///< spatial against object splits, first pairing, no mailbox
    double pairing_with_splits = 0;
    double splits_with_pairing = 0;
    double mailbox_with_first = 0;  ///< the mailbox against none, spatial splits, first pairing
    double mailbox_with_best = 0;   ///< the same with the best pairing
    double all = 0;                 ///< best pairing, splits and mailbox against none of them
};

[[nodiscard]] MailboxWorth worth_in(const MailboxReport& report, const std::string& scene);

}  // namespace rtu::study
