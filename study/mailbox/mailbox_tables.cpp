#include "study/mailbox/mailbox_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/mailbox/mailbox_summary.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

using sim::SplitKind;

std::string signed_percent(double value) { return fmt::format("{:+.1f}", value); }

const MailboxRow& row_of(const MailboxReport& report, const std::string& scene, const std::string& pairing,
                         SplitKind splits) {
    return *std::ranges::find_if(report.rows, [&](const MailboxRow& row) {
        return row.scene == scene && row.pairing == pairing && row.splits == splits;
    });
}

void for_each_tree(const MailboxReport& report, const auto& visit) {
    for (const std::string& scene : values_of(report, &MailboxRow::scene)) {
        for (const std::string& pairing : values_of(report, &MailboxRow::pairing)) visit(scene, pairing);
    }
}

double mebibytes(std::uint64_t bytes) { return double(bytes) / double(1U << 20U); }

}  // namespace

std::string tree_worth_table(const MailboxReport& report) {
    const std::vector<TreeWorth> worths = tree_worths(report);
    if (worths.empty()) return {};
    TextTable text({{"Scene", left_aligned},
                    {"Rays", left_aligned},
                    {"Pairing", left_aligned},
                    {"Pairing\nalone %"},
                    {"Splits\nalone %"},
                    {"Pairing with\nsplits %"},
                    {"Splits with\npairing %"},
                    {"Both\n%"}});
    std::string last = worths.front().scene;
    for (const TreeWorth& worth : worths) {
        if (worth.scene != last) text.add_rule();
        last = worth.scene;
        text.add_row({worth.scene, worth.workload, worth.pairing, signed_percent(worth.pairing_alone),
                      signed_percent(worth.splits_alone), signed_percent(worth.pairing_with_splits),
                      signed_percent(worth.splits_with_pairing), signed_percent(worth.both)});
    }
    return fmt::format("\nMRPS that pairing adds to pairing {}, and spatial splits to object splits\n{}",
                       report.rows.front().pairing, text.text());
}

std::string tree_table(const MailboxReport& report) {
    TextTable text({{"Scene", left_aligned},
                    {"Pairing", left_aligned},
                    {"Leaves\nadded %"},
                    {"Image, object\nMiB"},
                    {"spatial\nMiB"},
                    {"MRPS\nobject"},
                    {"MRPS\nspatial"},
                    {"Change\n%"}});
    for_each_tree(report, [&](const std::string& scene, const std::string& pairing) {
        const MailboxRow& object = row_of(report, scene, pairing, SplitKind::Object);
        const MailboxRow& spatial = row_of(report, scene, pairing, SplitKind::Spatial);
        const double before = total_mrps(report, scene, {}, pairing, SplitKind::Object, {});
        const double after = total_mrps(report, scene, {}, pairing, SplitKind::Spatial, {});
        text.add_row({scene, pairing, fixed(spatial.extra_leaf_percent, 1),
                      fixed(mebibytes(object.image_bytes), 2), fixed(mebibytes(spatial.image_bytes), 2),
                      fixed(before, 2), fixed(after, 2),
                      before > 0 ? signed_percent(100 * (after / before - 1)) : "-"});
    });
    return fmt::format("\nTrees with object and with spatial splits, all rays, no mailbox\n{}", text.text());
}

std::string mailbox_mrps_table(const MailboxReport& report) {
    const std::vector<MailboxCost> costs = mailbox_costs(report);
    std::vector<TextTable::Column> columns{{"Scene", left_aligned}, {"Pairing", left_aligned}, {"none"}};
    for (const MailboxCost& cost : costs) columns.push_back({mailbox_name(cost.mailbox)});
    TextTable text(columns);
    for_each_tree(report, [&](const std::string& scene, const std::string& pairing) {
        const auto cell = [&](const model::MailboxOptions& mailbox) {
            return fixed(total_mrps(report, scene, {}, pairing, SplitKind::Spatial, mailbox), 2);
        };
        std::vector<std::string> cells{scene, pairing, cell({})};
        for (const MailboxCost& cost : costs) cells.push_back(cell(cost.mailbox));
        text.add_row(cells);
    });
    return fmt::format("\nMRPS with spatial splits, all rays, by mailbox\n{}", text.text());
}

std::string mailbox_cost_table(const MailboxReport& report) {
    TextTable text({{"Mailbox", left_aligned},
                    {"Found"},
                    {"of the\nduplicates %"},
                    {"Gates\nadded"},
                    {"SRAM added\nKibit"},
                    {"MRPS, least\n%"},
                    {"most\n%"}});
    const std::vector<MailboxCost> costs = mailbox_costs(report);
    for (const MailboxCost& cost : costs) {
        text.add_row({mailbox_name(cost.mailbox), grouped(cost.found), percent(cost.found, cost.duplicates),
                      grouped(std::uint64_t(std::llround(cost.gates))), fixed(cost.sram_bits / 1024, 1),
                      fmt::format("{:+.2f}", cost.least_mrps_percent),
                      fmt::format("{:+.2f}", cost.most_mrps_percent)});
    }
    return fmt::format(
        "\nMailboxes over all trees with spatial splits, {} duplicates; MRPS against no mailbox\n{}",
        grouped(costs.front().duplicates), text.text());
}

}  // namespace rtu::study
