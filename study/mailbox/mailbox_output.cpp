#include "study/mailbox/mailbox_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/config_keys.hpp"
#include "study/json_output.hpp"
#include "study/mailbox/mailbox_summary.hpp"
#include "study/mailbox/mailbox_tables.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;
using sim::SplitKind;

std::string_view name_of(SplitKind splits) { return splits == SplitKind::Spatial ? "spatial" : "object"; }

std::string_view name_of(model::MailboxKind kind) {
    model::MailboxKind any = kind;
    return sim::choice_names(&any)[std::size_t(kind)];
}

Json json(const TreeWorth& worth) {
    return {{"scene", worth.scene},
            {"workload", worth.workload},
            {"pairing", worth.pairing},
            {"pairing_alone_percent", worth.pairing_alone},
            {"splits_alone_percent", worth.splits_alone},
            {"pairing_with_splits_percent", worth.pairing_with_splits},
            {"splits_with_pairing_percent", worth.splits_with_pairing},
            {"both_percent", worth.both}};
}

Json json(const MailboxCost& cost) {
    return {{"mailbox", name_of(cost.mailbox.kind)},
            {"entries", cost.mailbox.entries},
            {"found", cost.found},
            {"duplicates", cost.duplicates},
            {"gates_added", cost.gates},
            {"sram_bits_added", cost.sram_bits},
            {"least_mrps_percent", cost.least_mrps_percent},
            {"most_mrps_percent", cost.most_mrps_percent}};
}

Json json(const MailboxRow& row) {
    return {{"scene", row.scene},
            {"workload", row.workload},
            {"pairing", row.pairing},
            {"splits", name_of(row.splits)},
            {"mailbox", row.mailbox.is_on() ? name_of(row.mailbox.kind) : "none"},
            {"entries", row.mailbox.entries},
            {"extra_leaf_percent", row.extra_leaf_percent},
            {"image_bytes", row.image_bytes},
            {"rays", row.rays},
            {"cycles", row.cycles},
            {"box_tests", row.box_tests},
            {"pair_tests", row.pair_tests},
            {"duplicate_tests", row.duplicate_tests},
            {"lookups", row.lookups},
            {"mailbox_hits", row.mailbox_hits},
            {"bytes_saved", row.bytes_saved},
            {"bytes_moved", row.bytes_moved},
            {"all_hits", row.all_hits},
            {"reported_twice", row.reported_twice},
            {"mrps", row.mrps},
            {"gates", row.gates},
            {"sram_bits", row.sram_bits}};
}

std::string answer(const MailboxReport& report, const std::string& scene) {
    const MailboxWorth worth = worth_in(report, scene);
    const std::string first = values_of(report, &MailboxRow::pairing).front();
    return fmt::format(
        "{}: against {} and object splits, {} alone gives {:+.1f} % MRPS and spatial splits alone {:+.1f} "
        "%.\n"
        "  With splits, {} still gives {:+.1f} %; with {}, splits still give {:+.1f} %.\n"
        "  The best mailbox of the last pairs ({}) adds {:+.1f} % to splits with {} and {:+.1f} % with {}; "
        "all "
        "together {:+.1f} %.\n",
        scene, first, worth.best_pairing, worth.pairing_alone, worth.splits_alone, worth.best_pairing,
        worth.pairing_with_splits, worth.best_pairing, worth.splits_with_pairing, mailbox_name(worth.mailbox),
        worth.mailbox_with_first, first, worth.mailbox_with_best, worth.best_pairing, worth.all);
}

std::string table(const MailboxReport& report, const std::string& scene, const std::string& workload) {
    TextTable text({{"Pairing", left_aligned},
                    {"Splits", left_aligned},
                    {"Mailbox", left_aligned},
                    {"Leaves\nadded %"},
                    {"Box tests\na ray"},
                    {"Pair tests\na ray"},
                    {"of them\nagain %"},
                    {"Saved\na ray"},
                    {"MRPS"},
                    {"Gates\nthousand"},
                    {"SRAM\nKibit"}});
    std::string last;
    for (const MailboxRow& row : report.rows) {
        if (row.scene != scene || row.workload != workload) continue;
        const std::string tree = fmt::format("{} {}", row.pairing, name_of(row.splits));
        if (!last.empty() && last != tree) text.add_rule();
        last = tree;
        text.add_row({row.pairing, std::string(name_of(row.splits)), mailbox_name(row.mailbox),
                      fixed(row.extra_leaf_percent, 1), per(row.box_tests, row.rays),
                      per(row.pair_tests, row.rays), percent(row.duplicate_tests, row.pair_tests),
                      per(row.mailbox_hits, row.rays), fixed(row.mrps, 2), fixed(row.gates / 1e3, 1),
                      fixed(row.sram_bits / 1024, 1)});
    }
    return fmt::format("\n{}, {}\n{}", scene, workload, text.text());
}

}  // namespace

std::string mailbox_text(const MailboxReport& report) {
    std::string out =
        fmt::format("rtusim {}  seed {}  {} MHz  spatial splits add at most {} % of the pairs\n\n",
                    report.version, report.seed, report.clock_mhz, report.split_budget_percent);
    const std::vector<std::string> scenes = values_of(report, &MailboxRow::scene);
    for (const std::string& scene : scenes) out += answer(report, scene);
    out += tree_worth_table(report) + tree_table(report) + mailbox_mrps_table(report) +
           mailbox_cost_table(report);
    for (const std::string& scene : scenes) {
        for (const std::string& workload : values_of(report, &MailboxRow::workload)) {
            out += table(report, scene, workload);
        }
    }
    return out + "Gates and SRAM are those of all RTUs, as `rtusim area` has them.\n";
}

std::string mailbox_json(const MailboxReport& report) {
    Json document{{"version", report.version},     {"seed", report.seed},
                  {"clock_mhz", report.clock_mhz}, {"split_budget_percent", report.split_budget_percent},
                  {"worth", Json::array()},        {"mailboxes", Json::array()},
                  {"rows", Json::array()}};
    for (const TreeWorth& worth : tree_worths(report)) document["worth"].push_back(json(worth));
    for (const MailboxCost& cost : mailbox_costs(report)) document["mailboxes"].push_back(json(cost));
    for (const MailboxRow& row : report.rows) document["rows"].push_back(json(row));
    return json_text(document);
}

std::string mailbox_csv(const MailboxReport& report) {
    std::vector<Json> rows;
    for (const MailboxRow& row : report.rows) rows.push_back(json(row));
    return json_rows_csv(json(MailboxRow{}), rows);
}

}  // namespace rtu::study
