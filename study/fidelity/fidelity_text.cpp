#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "study/fidelity/fidelity_output.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

using Column = TextTable::Column;

// Of values in any order; 0 without any.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

std::vector<std::string> levels_of(const FidelityReport& report) {
    std::vector<std::string> levels;
    for (const FidelityRow& row : report.rows) {
        if (std::ranges::find(levels, row.level) == levels.end()) levels.push_back(row.level);
    }
    return levels;
}

// What a level did over all rows that have rays.
struct LevelSummary {
    std::vector<double> errors;  // %, without sign
    std::vector<double> speedups, host_rates;
    std::uint64_t intervals = 0, inside = 0, within_tolerance = 0, much_faster = 0;
};

constexpr double much_faster = 15;  // than the cycle model

LevelSummary summarise(const FidelityReport& report, const std::string& level) {
    LevelSummary summary;
    for (const FidelityRow& row : report.rows) {
        if (row.level != level || !row.error_percent) continue;
        summary.errors.push_back(std::abs(*row.error_percent));
        summary.speedups.push_back(row.speedup.value_or(0));
        summary.host_rates.push_back(row.host_rays_per_second);
        if (row.is_inside) ++summary.intervals;
        if (row.is_inside.value_or(false)) ++summary.inside;
        if (row.speedup.value_or(0) >= much_faster) ++summary.much_faster;
        if (std::abs(*row.error_percent) <= 100 * report.tolerance) ++summary.within_tolerance;
    }
    return summary;
}

std::string short_rate(double rays_per_second) {
    return rays_per_second >= 1e6 ? fmt::format("{:.1f} M", rays_per_second * 1e-6)
                                  : fmt::format("{:.0f} k", rays_per_second * 1e-3);
}

// What a level says in a cell: how far off it is, half its interval, how much faster it was.
std::string short_estimate(const FidelityRow& row) {
    if (!row.error_percent) return "-";
    std::string text = fmt::format("{:+.2f}", *row.error_percent);
    const double half = row.mrps > 0 ? 50 * (row.mrps_high - row.mrps_low) / row.mrps : 0;
    if (half > 0 && row.mrps_low > 0) text += fmt::format(" ({:.1f})", half);
    return text + fmt::format(" {:.2g}x", row.speedup.value_or(0));
}

// A line for each workload of a machine, a column for each level; the RTL's rays have no other levels.
std::string comparisons(const FidelityReport& report) {
    std::vector<std::string> levels = levels_of(report);
    std::erase(levels, "cycle");
    std::erase(levels, "rtl");
    std::vector<Column> columns{{"Scene", left_aligned},
                                {"Machine", left_aligned},
                                {"Workload", left_aligned},
                                {"All\nrays"},
                                {"cycle\nMRPS"}};
    for (const std::string& level : levels) columns.push_back({level + "\nerror (half) faster"});
    TextTable table(columns);
    std::string scene;
    for (std::size_t i = 0; i < report.rows.size();) {
        const FidelityRow& cycle = report.rows[i];
        if (cycle.level != "cycle") {
            ++i;
            continue;
        }
        if (i > 0 && cycle.scene != scene) table.add_rule();
        scene = cycle.scene;
        std::vector<std::string> cells{cycle.scene, cycle.machine, cycle.workload, grouped(cycle.total_rays),
                                       fmt::format("{:.2f}", cycle.mrps)};
        for (++i; i < report.rows.size() && cells.size() < columns.size(); ++i) {
            cells.push_back(short_estimate(report.rows[i]));
        }
        table.add_row(cells);
    }
    return table.text();
}

std::string rtl_comparisons(const FidelityReport& report) {
    TextTable table({{"Scene", left_aligned},
                     {"Workload", left_aligned},
                     {"Rays"},
                     {"RTL\nMRPS"},
                     {"RTL against\ncycle, %"},
                     {"RTL host\nrays/s"},
                     {"Cycle model\nfaster"}});
    for (const FidelityRow& row : report.rows) {
        if (row.level != "rtl") continue;
        table.add_row({row.scene, row.workload, grouped(row.total_rays), fmt::format("{:.2f}", row.mrps),
                       row.error_percent ? fmt::format("{:+.2f}", *row.error_percent) : "-",
                       short_rate(row.host_rays_per_second),
                       row.speedup ? fmt::format("{:.0f}x", 1 / *row.speedup) : "-"});
    }
    return table.text();
}

std::string rankings(const FidelityReport& report) {
    TextTable table({{"Scene", left_aligned},
                     {"Workload", left_aligned},
                     {"Level", left_aligned},
                     {"Kendall\ntau"},
                     {"Host\nCPU s"}});
    for (const FidelityRanking& ranking : report.rankings) {
        table.add_row({ranking.scene, ranking.workload, ranking.level, fmt::format("{:.3f}", ranking.tau),
                       fixed(ranking.host_seconds, 2)});
    }
    return table.text();
}

}  // namespace

std::string fidelity_summary(const FidelityReport& report) {
    TextTable table({{"Level", left_aligned},
                     {"Cases"},
                     {"Error, %\nmedian"},
                     {"Error, %\n95th"},
                     {"Error, %\nlargest"},
                     {"In 95 %\ninterval, %"},
                     {fmt::format("Within {:g} %,\n% of cases", 100 * report.tolerance)},
                     {"Host rays/s\nmedian"},
                     {"Faster\nmedian"},
                     {fmt::format("At least {:g}x,\n% of cases", much_faster)}});
    for (const std::string& level : levels_of(report)) {
        const LevelSummary all = summarise(report, level);
        table.add_row({level, grouped(all.errors.size()), fixed(quantile(all.errors, 0.5), 2),
                       fixed(quantile(all.errors, 0.95), 2), fixed(quantile(all.errors, 1), 2),
                       percent(all.inside, all.intervals), percent(all.within_tolerance, all.errors.size()),
                       short_rate(quantile(all.host_rates, 0.5)),
                       fmt::format("{:.2g}x", quantile(all.speedups, 0.5)),
                       percent(all.much_faster, all.errors.size())});
    }
    return table.text();
}

std::string fidelity_text(const FidelityReport& report) {
    std::string out =
        fmt::format("Fidelity, rtusim {}: {} x {} pixels, seed {}, tolerance {:g} %\n\n", report.version,
                    report.resolution.width, report.resolution.height, report.seed, 100 * report.tolerance);
    out += "Every level against every ray through the cycle model\n" + fidelity_summary(report) + "\n";
    out +=
        "Every case: error of MRPS in %, in parentheses half the 95 % interval, how many times faster than "
        "cycle\n";
    out += comparisons(report);
    if (std::ranges::find(report.rows, "rtl", &FidelityRow::level) != report.rows.end()) {
        out += "\nThe Verilated RTU and the cycle model, the same rays on the machine of the RTL\n";
        out += rtl_comparisons(report);
    }
    if (!report.rankings.empty()) {
        out += fmt::format("\nOrder of {} machines by MRPS: Kendall's tau against the cycle model\n",
                           report.rankings.front().machines);
        out += rankings(report);
    }
    return out;
}

std::string estimates_text(std::span<const FidelityRow> rows) {
    TextTable table({{"Scene", left_aligned},
                     {"Workload", left_aligned},
                     {"Level", left_aligned},
                     {"MRPS"},
                     {"95 % interval"},
                     {"Simulated\nrays"},
                     {"Traced\nrays"},
                     {"All\nrays"},
                     {"Host\nrays/s"}});
    for (const FidelityRow& row : rows) {
        table.add_row({row.scene, row.workload, row.level, fmt::format("{:.2f}", row.mrps),
                       fmt::format("{:.2f} - {:.2f}", row.mrps_low, row.mrps_high),
                       grouped(row.simulated_rays), grouped(row.traced_rays), grouped(row.total_rays),
                       short_rate(row.host_rays_per_second)});
    }
    std::string out = table.text() + "\nWhat was modelled\n";
    for (const FidelityRow& row : rows) {
        out += fmt::format("  {}, {}: {}\n", row.scene, row.workload, row.account);
    }
    return out;
}

Chart fidelity_chart(const FidelityReport& report) {
    Chart chart;
    chart.name = "fidelity";
    chart.title = "Host speed and error of each level against every ray simulated: a point for every scene";
    chart.x_label = "thousand rays of the workload per second of host CPU time, median";
    chart.y_label = "error of MRPS, %, median";
    chart.is_x_logarithmic = true;
    chart.x_base = 10;
    chart.y_floor = 0.01;
    chart.has_lines = false;
    std::size_t colour = 0;
    for (const std::string& level : levels_of(report)) {
        std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> scenes;
        for (const FidelityRow& row : report.rows) {
            if (row.level != level || !row.error_percent) continue;
            scenes[row.scene].first.push_back(row.host_rays_per_second * 1e-3);
            scenes[row.scene].second.push_back(std::abs(*row.error_percent));
        }
        ChartSeries& series = chart.series.emplace_back();
        series.name = level;
        series.colour = colour++;
        for (const auto& [scene, values] : scenes) {
            series.points.emplace_back(quantile(values.first, 0.5), quantile(values.second, 0.5));
        }
    }
    return chart;
}

}  // namespace rtu::study
