#pragma once

#include <string>
#include <vector>

#include "study/mailbox/mailbox_study.hpp"

namespace rtu::study {

/// The values of a column in the order in which they first come.
[[nodiscard]] std::vector<std::string> values_of(const MailboxReport& report,
                                                 std::string MailboxRow::*column);

/// MRPS of one workload of a scene, or of all together (no name): their rays over their cycles. 0 without
/// such rows.
[[nodiscard]] double total_mrps(const MailboxReport& report, const std::string& scene,
                                const std::string& workload, const std::string& pairing,
                                sim::SplitKind splits, const model::MailboxOptions& mailbox);

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

/// What a pairing and splits are worth to rays of one kind, without a mailbox; percent of MRPS.
struct TreeWorth {
    std::string scene;
    std::string workload;  ///< "all": all together
    std::string pairing;   ///< against the first one
    double pairing_alone = 0;
    double splits_alone = 0;  ///< with the first pairing
    double pairing_with_splits = 0;
    double splits_with_pairing = 0;
    double both = 0;  ///< pairing and splits against neither
};

/// Of every scene, workload and pairing but the first, all workloads together last.
[[nodiscard]] std::vector<TreeWorth> tree_worths(const MailboxReport& report);

/// What one mailbox finds in all trees with spatial splits, and what it adds to the machine.
struct MailboxCost {
    model::MailboxOptions mailbox;
    std::uint64_t found = 0;        ///< duplicate tests that it saved
    std::uint64_t duplicates = 0;   ///< that there are without a mailbox
    double gates = 0;               ///< more than without
    double sram_bits = 0;           ///< likewise
    double least_mrps_percent = 0;  ///< change of MRPS, of one scene with one pairing, all its workloads
    double most_mrps_percent = 0;
};

/// Of every mailbox of the report, in its order.
[[nodiscard]] std::vector<MailboxCost> mailbox_costs(const MailboxReport& report);

}  // namespace rtu::study
