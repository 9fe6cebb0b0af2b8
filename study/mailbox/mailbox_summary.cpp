#include "study/mailbox/mailbox_summary.hpp"

#include <algorithm>

#include "study/report/run_report.hpp"

namespace rtu::study {
namespace {

using sim::SplitKind;

double change(double before, double after) { return before > 0 ? 100 * (after / before - 1) : 0; }

}  // namespace

std::vector<std::string> values_of(const MailboxReport& report, std::string MailboxRow::*column) {
    std::vector<std::string> values;
    for (const MailboxRow& row : report.rows) {
        if (std::ranges::find(values, row.*column) == values.end()) values.push_back(row.*column);
    }
    return values;
}

double total_mrps(const MailboxReport& report, const std::string& scene, const std::string& pairing,
                  SplitKind splits, const model::MailboxOptions& mailbox) {
    std::uint64_t rays = 0, cycles = 0;
    for (const MailboxRow& row : report.rows) {
        if (row.scene != scene || row.pairing != pairing || row.splits != splits || row.mailbox != mailbox) {
            continue;
        }
        rays += row.rays;
        cycles += row.cycles;
    }
    return mrps(rays, cycles, report.clock_mhz);
}

MailboxWorth worth_in(const MailboxReport& report, const std::string& scene) {
    const auto of = [&](const std::string& pairing, SplitKind splits,
                        const model::MailboxOptions& mailbox = {}) {
        return total_mrps(report, scene, pairing, splits, mailbox);
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

}  // namespace rtu::study
