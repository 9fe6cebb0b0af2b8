#include <fmt/format.h>

#include <cctype>
#include <functional>

#include "study/mailbox/mailbox_output.hpp"
#include "study/mailbox/mailbox_summary.hpp"

namespace rtu::study {
namespace {

using sim::SplitKind;
using Value = std::function<double(const MailboxRow&)>;

std::string file_name(const std::string& scene, std::string_view what) {
    std::string name = fmt::format("mailbox_{}_{}", scene, what);
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return name;
}

// A line for each pairing: the mailboxes of the last pairs, and none at 0; dashed, the tree without splits.
Chart panel(const MailboxReport& report, const std::string& scene, const std::string& workload,
            const std::string& y_label, const Value& value) {
    Chart chart;
    chart.title = workload;
    chart.x_label = "entries of the mailbox";
    chart.y_label = y_label;
    std::size_t colour = 0;
    for (const std::string& pairing : values_of(report, &MailboxRow::pairing)) {
        ChartSeries split{.name = pairing + ", spatial splits", .points = {}, .level = {}, .marks = {}};
        ChartSeries whole{.name = pairing + ", object splits", .points = {}, .level = {}, .marks = {}};
        split.colour = whole.colour = colour++;
        for (const MailboxRow& row : report.rows) {
            if (row.scene != scene || row.workload != workload || row.pairing != pairing) continue;
            if (row.splits == SplitKind::Object) {
                whole.level = value(row);
            } else if (row.mailbox.kind == model::MailboxKind::Recent) {
                split.points.emplace_back(row.mailbox.entries, value(row));
            }
        }
        chart.series.push_back(std::move(split));
        chart.series.push_back(std::move(whole));
    }
    return chart;
}

ChartPanels panels(const MailboxReport& report, const std::string& scene, std::string_view what,
                   const std::string& y_label, const Value& value) {
    ChartPanels all{file_name(scene, what), fmt::format("{}: {}", scene, y_label), {}};
    for (const std::string& workload : values_of(report, &MailboxRow::workload)) {
        all.panels.push_back(panel(report, scene, workload, y_label, value));
    }
    return all;
}

// Of the tests of the tree with splits, those that the mailbox saves.
ChartPanels saved_panels(const MailboxReport& report, const std::string& scene) {
    ChartPanels all = panels(report, scene, "saved", "pair tests saved, %", [](const MailboxRow& row) {
        const std::uint64_t without = row.pair_tests + row.mailbox_hits;
        return without > 0 ? 100 * double(row.mailbox_hits) / double(without) : 0;
    });
    for (Chart& chart : all.panels) {
        std::erase_if(chart.series, [](const ChartSeries& series) { return series.level.has_value(); });
        chart.has_zero_line = true;
    }
    return all;
}

// Of one machine, whatever the scene.
Chart gates_chart(const MailboxReport& report) {
    Chart chart;
    chart.name = "mailbox_gates";
    chart.title = "Gates that a mailbox of the last pairs adds";
    chart.x_label = "entries of the mailbox";
    chart.y_label = "gates";
    chart.has_zero_line = true;
    ChartSeries series{.name = "gates", .points = {{0, 0}}, .level = {}, .marks = {}};
    for (const MailboxCost& cost : mailbox_costs(report)) {
        if (cost.mailbox.kind == model::MailboxKind::Recent) {
            series.points.emplace_back(cost.mailbox.entries, cost.gates);
        }
    }
    chart.series.push_back(std::move(series));
    return chart;
}

}  // namespace

std::vector<AnyChart> mailbox_charts(const MailboxReport& report) {
    std::vector<AnyChart> charts{gates_chart(report)};
    for (const std::string& scene : values_of(report, &MailboxRow::scene)) {
        charts.emplace_back(panels(report, scene, "tests", "pair tests a ray", [](const MailboxRow& row) {
            return row.rays > 0 ? double(row.pair_tests) / double(row.rays) : 0;
        }));
        charts.emplace_back(
            panels(report, scene, "mrps", "MRPS", [](const MailboxRow& row) { return row.mrps; }));
        charts.emplace_back(saved_panels(report, scene));
        charts.emplace_back(panels(report, scene, "per_gate", "MRPS per million gates",
                                   [](const MailboxRow& row) { return row.mrps / (row.gates / 1e6); }));
    }
    return charts;
}

}  // namespace rtu::study
