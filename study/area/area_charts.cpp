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

// Against two independent testers, for each scene: a bar for the change of `bar` in each other mode, a
// diamond for that of `mark`.
Chart change_chart(const AreaReport& report, Member bar, Member mark) {
    Chart chart;
    chart.groups = names_of(report, &AreaRow::scene);
    chart.y_label = "change of MRPS per million gates, %";
    chart.mark_name = "change of MRPS, %";
    for (const PairMode mode : {PairMode::Single, PairMode::DualShared}) {
        ChartSeries& series = chart.series.emplace_back();
        series.name = sim::pair_mode_names()[std::size_t(mode)];
        series.colour = std::size_t(mode);
        for (std::size_t i = 0; i < chart.groups.size(); ++i) {
            const auto change = [&](Member rate) {
                const double before = scene_rate(report, chart.groups[i], PairMode::DualIndependent, rate);
                return change_percent(before, scene_rate(report, chart.groups[i], mode, rate)).value_or(0);
            };
            series.points.emplace_back(double(i), change(bar));
            series.marks.emplace_back(double(i), change(mark));
        }
    }
    return chart;
}

Chart unit_chart(const AreaReport& report) {
    Chart chart = change_chart(report, &AreaRow::pair_limit_mrps_per_mgate, &AreaRow::pair_limit_mrps);
    chart.name = "area_pair_unit";
    chart.title =
        fmt::format("Pair unit of {} alone, against two independent testers; sharing saves {:.1f} % of it",
                    report.machine.machine.name, saved_pair_percent(report));
    return chart;
}

Chart machine_chart(const AreaReport& report) {
    Chart chart = change_chart(report, &AreaRow::mrps_per_mgate, &AreaRow::mrps);
    chart.name = "area_machine";
    chart.title =
        fmt::format("Machine {}, against two independent testers; sharing saves {:.1f} % of its gates",
                    report.machine.machine.name, saved_machine_percent(report));
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
            series.points.emplace_back(
                double(i), scene_rate(report, chart.groups[i], mode.mode, &AreaRow::mrps_per_mgate));
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
