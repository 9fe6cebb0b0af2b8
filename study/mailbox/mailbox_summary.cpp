#include "study/mailbox/mailbox_summary.hpp"

#include <algorithm>

#include "study/report/run_report.hpp"

namespace rtu::study {
namespace {

using sim::SplitKind;

double change(double before, double after) { return before > 0 ? 100 * (after / before - 1) : 0; }

TreeWorth tree_worth(const MailboxReport& report, const std::string& scene, const std::string& workload,
                     const std::string& pairing) {
    const auto of = [&](const std::string& method, SplitKind splits) {
        return total_mrps(report, scene, workload, method, splits, {});
    };
    const std::string& first = report.rows.front().pairing;
    const double neither = of(first, SplitKind::Object), split = of(first, SplitKind::Spatial),
                 paired = of(pairing, SplitKind::Object), both = of(pairing, SplitKind::Spatial);
    return {.scene = scene,
            .workload = workload.empty() ? "all" : workload,
            .pairing = pairing,
            .pairing_alone = change(neither, paired),
            .splits_alone = change(neither, split),
            .pairing_with_splits = change(split, both),
            .splits_with_pairing = change(paired, both),
            .both = change(neither, both)};
}

// What the mailbox does to the MRPS of every scene with every pairing.
void add_mrps_range(const MailboxReport& report, MailboxCost& cost) {
    bool is_first = true;
    for (const std::string& scene : values_of(report, &MailboxRow::scene)) {
        for (const std::string& pairing : values_of(report, &MailboxRow::pairing)) {
            const auto of = [&](const model::MailboxOptions& mailbox) {
                return total_mrps(report, scene, {}, pairing, SplitKind::Spatial, mailbox);
            };
            const double percent = change(of({}), of(cost.mailbox));
            cost.least_mrps_percent = is_first ? percent : std::min(cost.least_mrps_percent, percent);
            cost.most_mrps_percent = is_first ? percent : std::max(cost.most_mrps_percent, percent);
            is_first = false;
        }
    }
}

}  // namespace

std::vector<std::string> values_of(const MailboxReport& report, std::string MailboxRow::*column) {
    std::vector<std::string> values;
    for (const MailboxRow& row : report.rows) {
        if (std::ranges::find(values, row.*column) == values.end()) values.push_back(row.*column);
    }
    return values;
}

double total_mrps(const MailboxReport& report, const std::string& scene, const std::string& workload,
                  const std::string& pairing, SplitKind splits, const model::MailboxOptions& mailbox) {
    std::uint64_t rays = 0, cycles = 0;
    for (const MailboxRow& row : report.rows) {
        if (row.scene != scene || row.pairing != pairing || row.splits != splits || row.mailbox != mailbox) {
            continue;
        }
        if (!workload.empty() && row.workload != workload) continue;
        rays += row.rays;
        cycles += row.cycles;
    }
    return mrps(rays, cycles, report.clock_mhz);
}

MailboxWorth worth_in(const MailboxReport& report, const std::string& scene) {
    const auto of = [&](const std::string& pairing, SplitKind splits,
                        const model::MailboxOptions& mailbox = {}) {
        return total_mrps(report, scene, {}, pairing, splits, mailbox);
    };
    const std::vector<std::string> pairings = values_of(report, &MailboxRow::pairing);
    const std::string& first = pairings.front();
    const std::string best = *std::ranges::max_element(
        pairings, {}, [&](const std::string& pairing) { return of(pairing, SplitKind::Object); });
    MailboxWorth worth{.best_pairing = best, .mailbox = {}};
    for (const MailboxRow& row : report.rows) {
        if (row.mailbox.kind != model::MailboxKind::Recent) continue;
        if (of(best, SplitKind::Spatial, row.mailbox) > of(best, SplitKind::Spatial, worth.mailbox)) {
            worth.mailbox = row.mailbox;
        }
    }
    const double first_object = of(first, SplitKind::Object), first_split = of(first, SplitKind::Spatial),
                 best_object = of(best, SplitKind::Object), best_split = of(best, SplitKind::Spatial),
                 best_all = of(best, SplitKind::Spatial, worth.mailbox);
    worth.pairing_alone = change(first_object, best_object);
    worth.splits_alone = change(first_object, first_split);
    worth.pairing_with_splits = change(first_split, best_split);
    worth.splits_with_pairing = change(best_object, best_split);
    worth.mailbox_with_first = change(first_split, of(first, SplitKind::Spatial, worth.mailbox));
    worth.mailbox_with_best = change(best_split, best_all);
    worth.all = change(first_object, best_all);
    return worth;
}

std::vector<TreeWorth> tree_worths(const MailboxReport& report) {
    std::vector<TreeWorth> worths;
    const std::vector<std::string> pairings = values_of(report, &MailboxRow::pairing);
    std::vector<std::string> workloads = values_of(report, &MailboxRow::workload);
    if (workloads.size() > 1) workloads.emplace_back();
    for (const std::string& scene : values_of(report, &MailboxRow::scene)) {
        for (const std::string& workload : workloads) {
            for (std::size_t i = 1; i < pairings.size(); ++i) {
                worths.push_back(tree_worth(report, scene, workload, pairings[i]));
            }
        }
    }
    return worths;
}

std::vector<MailboxCost> mailbox_costs(const MailboxReport& report) {
    std::vector<MailboxCost> costs;
    const MailboxRow* none = nullptr;  // the row of the same tree and rays without a mailbox: it comes first
    for (const MailboxRow& row : report.rows) {
        if (row.splits != SplitKind::Spatial) continue;
        if (!row.mailbox.is_on()) {
            none = &row;
            continue;
        }
        auto cost = std::ranges::find(costs, row.mailbox, &MailboxCost::mailbox);
        if (cost == costs.end()) {
            cost = costs.insert(costs.end(), {.mailbox = row.mailbox,
                                              .gates = row.gates - none->gates,
                                              .sram_bits = row.sram_bits - none->sram_bits});
        }
        cost->found += row.mailbox_hits;
        cost->duplicates += none->duplicate_tests;
    }
    for (MailboxCost& cost : costs) add_mrps_range(report, cost);
    return costs;
}

}  // namespace rtu::study
