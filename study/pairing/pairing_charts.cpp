#include "study/pairing/pairing_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "study/pairing/pairing_study.hpp"

namespace rtu::study {
namespace {

// A method's name as part of a file's: window:4 -> window_4.
std::string file_part(std::string name) {
    std::ranges::replace(name, ':', '_');
    return name;
}

using RowValue = std::optional<double> (*)(const PairingRow&);

struct Quantity {
    std::string_view key;
    std::string_view name;
    double PublishedRow::*published;
};

constexpr std::array quantities = std::to_array<Quantity>({
    {"delta_box_percent", "box tests", &PublishedRow::delta_box_percent},
    {"delta_tri_percent", "tri (pair) tests", &PublishedRow::delta_tri_percent},
    {"delta_mrps_percent", "MRPS", &PublishedRow::delta_mrps_percent},
});

Chart comparison_chart(const PairingReport& report, const std::string& method) {
    Chart chart;
    chart.name = "pairing_" + file_part(method);
    chart.title = fmt::format("{} instead of {}, preset {}", method, report.baseline, report.preset);
    chart.y_label = "change (%)";
    for (const Quantity& quantity : quantities) {
        chart.series.push_back({std::string(quantity.name), {}, {}, {}, chart.series.size()});
    }
    for (const PairingRow& row : report.rows) {
        if (row.method != method) continue;
        const auto group = double(chart.groups.size());
        const bool is_other_mesh = row.published != nullptr && !row.mesh.is_papers_mesh;
        chart.groups.push_back(row.scene + (is_other_mesh ? "*" : ""));
        for (std::size_t i = 0; i < quantities.size(); ++i) {
            const auto value = pairing_column(quantities[i].key).value(row);
            if (value) chart.series[i].points.emplace_back(group, *value);
            if (row.published == nullptr) continue;
            chart.mark_name = "published";
            chart.series[i].marks.emplace_back(group, row.published->*quantities[i].published);
        }
        if (is_other_mesh) chart.x_label = "* published for another edition of the scene";
    }
    return chart;
}

// The series of a scene and method; made when it is new.
ChartSeries& series_of(Chart& chart, const std::string& name) {
    const auto found = std::ranges::find(chart.series, name, &ChartSeries::name);
    if (found != chart.series.end()) return *found;
    return chart.series.emplace_back(ChartSeries{name, {}, {}, {}, chart.series.size()});
}

std::string series_name(const PairingReport& report, const PairingRow& row) {
    return report.methods.size() > 1 ? fmt::format("{}, {}", row.scene, row.method) : row.scene;
}

Chart framed(const PairingReport& report, const PairingStudyInfo& what, std::string_view suffix) {
    Chart chart;
    chart.name = fmt::format("{}_{}", what.name, suffix);
    chart.x_label = what.axis;
    chart.is_x_logarithmic = what.is_logarithmic;
    const bool is_window = what.kind == PairingStudyKind::Window;
    chart.title = fmt::format("{} instead of {}",
                              is_window ? "window:N" : fmt::format("{}", fmt::join(report.methods, ", ")),
                              report.baseline);
    if (what.kind != PairingStudyKind::Preset) chart.title += fmt::format(", preset {}", report.preset);
    return chart;
}

// One line a scene (and method); of `window`, the methods without a window are dashed levels.
Chart line_chart(const PairingReport& report, const PairingStudyTable& study, std::string_view suffix,
                 RowValue value) {
    Chart chart = framed(report, info(study.kind), suffix);
    const bool is_window = study.kind == PairingStudyKind::Window;
    for (const PairingPoint& point : study.points) {
        const auto y = value(point.row);
        if (!y) continue;
        if (is_window) {
            const std::string method = point.x ? "window:N" : point.row.method;
            ChartSeries& series = series_of(chart, fmt::format("{}, {}", point.row.scene, method));
            series.colour =
                std::size_t(std::ranges::find(report.scenes, point.row.scene,
                                              [](const PairingScene& scene) -> const std::string& {
                                                  return scene.facts.name;
                                              }) -
                            report.scenes.begin());
            if (point.x) {
                series.points.emplace_back(*point.x, *y);
            } else {
                series.level = *y;
            }
        } else if (point.x) {
            series_of(chart, series_name(report, point.row)).points.emplace_back(*point.x, *y);
        }
    }
    return chart;
}

// A group a setting, a bar a scene (and method).
Chart bar_chart(const PairingReport& report, const PairingStudyTable& study, std::string_view suffix,
                RowValue value) {
    Chart chart = framed(report, info(study.kind), suffix);
    for (const PairingPoint& point : study.points) {
        auto group = std::ranges::find(chart.groups, point.setting);
        if (group == chart.groups.end()) group = chart.groups.insert(group, point.setting);
        ChartSeries& series = series_of(chart, series_name(report, point.row));
        const auto y = value(point.row);
        if (y) series.points.emplace_back(double(group - chart.groups.begin()), *y);
    }
    return chart;
}

// MRPS of every tester with the old and the new pairs, against the `single` tester with the old pairs.
Chart tester_chart(const PairingReport& report, const PairingStudyTable& study) {
    Chart chart = framed(report, info(study.kind), "gain");
    chart.title =
        fmt::format("MRPS against a single tester with {}, preset {}", report.baseline, report.preset);
    chart.y_label = "change of MRPS (%)";
    double reference = 0;
    for (const PairingPoint& point : study.points) {
        const PairingRow& row = point.row;
        if (point.setting == study.points.front().setting) reference = row.before.mrps();
        const std::string group = series_name(report, row);
        auto place = std::ranges::find(chart.groups, group);
        if (place == chart.groups.end()) place = chart.groups.insert(place, group);
        const auto index = double(place - chart.groups.begin());
        const auto add = [&](const std::string& pairs, const PairingRun& run) {
            const auto change = change_percent(reference, run.mrps());
            if (change)
                series_of(chart, fmt::format("{}, {}", point.setting, pairs))
                    .points.emplace_back(index, *change);
        };
        add(row.baseline, row.before);
        add(report.methods.size() > 1 ? "method" : row.method, row.after);
    }
    return chart;
}

std::optional<double> mrps_change(const PairingRow& row) {
    return pairing_column("delta_mrps_percent").value(row);
}

std::optional<double> new_paired(const PairingRow& row) { return row.after.pairing.paired_percent; }

}  // namespace

std::vector<Chart> comparison_charts(const PairingReport& report) {
    std::vector<Chart> charts;
    if (report.rows.empty()) return charts;
    for (const std::string& method : report.methods) charts.push_back(comparison_chart(report, method));
    return charts;
}

std::vector<Chart> study_charts(const PairingReport& report, const PairingStudyTable& study) {
    std::vector<Chart> charts;
    switch (study.kind) {
        case PairingStudyKind::Testers:
            return {tester_chart(report, study)};
        case PairingStudyKind::RayKind:
        case PairingStudyKind::Preset:
            charts.push_back(bar_chart(report, study, "mrps", mrps_change));
            break;
        case PairingStudyKind::Window:
        case PairingStudyKind::Rotation:
            charts.push_back(line_chart(report, study, "paired", new_paired));
            charts.back().y_label = "paired triangles (%)";
            charts.push_back(line_chart(report, study, "mrps", mrps_change));
            break;
        case PairingStudyKind::L1Size:
        case PairingStudyKind::L2Size:
        case PairingStudyKind::DramBandwidth:
            charts.push_back(line_chart(report, study, "mrps", mrps_change));
            break;
    }
    charts.back().y_label = "change of MRPS (%)";
    charts.back().has_zero_line = true;
    return charts;
}

}  // namespace rtu::study
