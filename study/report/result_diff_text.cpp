#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/report/result_diff.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

constexpr std::size_t most_rows = 40;

std::string percent_text(double percent) {
    return std::isinf(percent) ? "from 0" : fmt::format("{:+.3f}", percent);
}

std::string number_text(double value) { return fmt::format("{:.7g}", value); }

std::string missing(const std::vector<std::string>& rows, const char* where) {
    if (rows.empty()) return "";
    std::string text = fmt::format("Only in the {} ({} rows):\n", where, rows.size());
    for (std::size_t i = 0; i < std::min(rows.size(), std::size_t{10}); ++i) text += "  " + rows[i] + "\n";
    return text + "\n";
}

std::string change_table(const std::vector<ResultChange>& all, double tolerance_percent) {
    std::vector<const ResultChange*> changes;
    changes.reserve(all.size());
    for (const ResultChange& change : all) changes.push_back(&change);
    // What the whole machine did stands first, then its units, the largest changes before the others.
    std::ranges::stable_sort(changes, {}, [](const ResultChange* change) {
        const bool is_of_unit = change->name.find('.') != std::string::npos;
        return is_of_unit ? std::pair(1, -std::abs(change->percent())) : std::pair(0, 0.0);
    });
    TextTable table({{"Row", left_aligned},
                     {"Number", left_aligned},
                     {"First"},
                     {"Second"},
                     {"Change\n%"},
                     {"Significant", left_aligned}});
    for (std::size_t i = 0; i < std::min(changes.size(), most_rows); ++i) {
        const ResultChange& change = *changes[i];
        table.add_row({change.row, change.name, number_text(change.before), number_text(change.after),
                       percent_text(change.percent()),
                       std::abs(change.percent()) > tolerance_percent ? "yes" : "no"});
    }
    std::string text = table.text();
    if (changes.size() > most_rows)
        text += fmt::format("  ... and {} smaller ones\n", changes.size() - most_rows);
    return text;
}

std::string trend_table(const std::vector<ResultTrend>& trends) {
    TextTable table({{"Number", left_aligned},
                     {"Rows"},
                     {"Up"},
                     {"Down"},
                     {"Significant"},
                     {"Mean\n%"},
                     {"Sign test\np"},
                     {"Largest\n%"},
                     {"in", left_aligned}});
    for (const ResultTrend& trend : trends) {
        table.add_row({trend.name, grouped(trend.compared), grouped(trend.up), grouped(trend.down),
                       grouped(trend.significant), percent_text(trend.mean_percent),
                       fmt::format("{:.2g}", trend.p_value), percent_text(trend.largest.percent()),
                       trend.largest.row});
    }
    return table.text();
}

}  // namespace

std::string diff_text(const ResultDiff& diff, bool is_sweep, double tolerance_percent) {
    std::string text;
    if (!diff.inputs.empty()) {
        text += "Inputs that differ:\n";
        for (const std::string& line : diff.inputs) text += "  " + line + "\n";
        text += "\n";
    }
    text += missing(diff.only_before, "first") + missing(diff.only_after, "second");
    text +=
        fmt::format("{} of {} numbers changed, {} of them by more than {} %\n", grouped(diff.changes.size()),
                    grouped(diff.compared), grouped(diff.significant), tolerance_percent);
    if (diff.changes.empty()) return text;
    return text + "\n" +
           (is_sweep ? trend_table(diff.trends) : change_table(diff.changes, tolerance_percent));
}

}  // namespace rtu::study
