#include "study/area/area_charts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/config_keys.hpp"
#include "study/pairing/pairing_report.hpp"

namespace rtu::study {
namespace {

using sim::PairMode;
using Member = double AreaRow::*;

std::vector<std::string> names_of(const AreaReport& report, std::string AreaRow::*member) {
    std::vector<std::string> names;
    for (const AreaRow& row : report.rows) {
        if (std::ranges::find(names, row.*member) == names.end()) names.push_back(row.*member);
    }
    return names;
}

double index_of(const std::vector<std::string>& names, const std::string& name) {
    return double(std::ranges::find(names, name) - names.begin());
}

// A bar for each scene and workload: the change of `bar`; a diamond: the change of `mark`.
Chart change_chart(const AreaReport& report, Member bar, Member mark) {
    Chart chart;
    chart.groups = names_of(report, &AreaRow::scene);
    const std::vector<std::string> workloads = names_of(report, &AreaRow::workload);
    for (std::size_t i = 0; i < workloads.size(); ++i) {
        ChartSeries& series = chart.series.emplace_back();
        series.name = workloads[i];
        series.colour = i;
        for (const AreaRow& row : report.rows) {
            if (row.workload != workloads[i] || row.mode != PairMode::DualShared) continue;
            const AreaRow& dual = in_mode(report, row, PairMode::DualIndependent);
            const double x = index_of(chart.groups, row.scene);
            series.points.emplace_back(x, change_percent(dual.*bar, row.*bar).value_or(0));
            series.marks.emplace_back(x, change_percent(dual.*mark, row.*mark).value_or(0));
        }
    }
    return chart;
}

Chart unit_chart(const AreaReport& report) {
    Chart chart = change_chart(report, &AreaRow::pair_limit_mrps_per_mgate, &AreaRow::pair_limit_mrps);
    chart.name = "area_pair_unit";
    chart.title = fmt::format("Pair unit alone: sharing the common edge saves {:.1f} % of its gates",
                              saved_pair_percent(report));
    chart.mark_name = "change of MRPS, %";
    chart.y_label = "change of MRPS per million gates, %";
    return chart;
}

Chart machine_chart(const AreaReport& report) {
    Chart chart = change_chart(report, &AreaRow::mrps_per_mgate, &AreaRow::mrps);
    chart.name = "area_machine";
    chart.title = fmt::format("Whole machine: sharing the common edge saves {:.1f} % of its gates",
                              saved_machine_percent(report));
    chart.mark_name = "change of MRPS, %";
    chart.y_label = "change of MRPS per million gates, %";
    return chart;
}

// All workloads of a scene together.
Chart mode_chart(const AreaReport& report) {
    Chart chart;
    chart.name = "area_modes";
    chart.title = "MRPS per million gates of the machine, by mode of the pair unit";
    chart.y_label = "MRPS per million gates";
    chart.groups = names_of(report, &AreaRow::scene);
    for (const ModeArea& mode : report.modes) {
        ChartSeries& series = chart.series.emplace_back();
        series.name = sim::pair_mode_names()[std::size_t(mode.mode)];
        series.colour = std::size_t(mode.mode);
        for (std::size_t i = 0; i < chart.groups.size(); ++i) {
            std::uint64_t rays = 0, cycles = 0;
            for (const AreaRow& row : report.rows) {
                if (row.scene != chart.groups[i] || row.mode != mode.mode) continue;
                rays += row.rays;
                cycles += row.cycles;
            }
            const double mrps =
                cycles == 0 ? 0 : double(rays) / double(cycles) * report.machine.machine.config.clock_mhz;
            series.points.emplace_back(double(i), mrps / (mode.machine_gates / 1e6));
        }
    }
    return chart;
}

Chart preset_chart(const AreaReport& report) {
    Chart chart;
    chart.name = "area_presets";
    chart.title = "Gates of one RTU of each preset, by unit";
    chart.y_label = "thousand gates";
    std::size_t colour = 0;
    for (const char* unit : {"box", "pair", "scheduler", "queues", "l1"}) {
        ChartSeries& series = chart.series.emplace_back();
        series.name = unit;
        series.colour = colour++;
        for (std::size_t i = 0; i < report.presets.size(); ++i) {
            series.points.emplace_back(double(i), report.presets[i].unit(unit).gates.gates / 1000);
        }
    }
    for (const MachineArea& preset : report.presets) chart.groups.push_back(preset.machine.name);
    return chart;
}

}  // namespace

std::vector<AnyChart> area_charts(const AreaReport& report) {
    std::vector<AnyChart> charts{preset_chart(report)};
    if (report.rows.empty()) return charts;
    for (Chart& chart : std::vector{unit_chart(report), machine_chart(report), mode_chart(report)}) {
        charts.emplace_back(std::move(chart));
    }
    return charts;
}

}  // namespace rtu::study
