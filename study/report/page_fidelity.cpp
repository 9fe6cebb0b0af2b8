#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// On a logarithmic axis there is no 0.
constexpr double least_shown_percent = 0.01;

PageChart level_error_chart(const Json& rows) {
    PageChart chart;
    chart.kind = PageChart::Kind::Points;
    chart.title = "Error against speed";
    chart.note = "A point is a scene, machine and workload. Errors below 0.01 % are drawn at 0.01 %.";
    chart.columns = {{"Scene"},
                     {"Machine"},
                     {"Workload"},
                     {"Level"},
                     {"Speed, times every ray", 2},
                     {"MRPS", 2},
                     {"Error, %", 3},
                     {"Drawn at", 3},
                     {"Interval from", 2},
                     {"Interval to", 2}};
    for (const Json& row : rows) {
        if (text_at(row, "level") == "cycle" || row.at("error_percent").is_null()) continue;
        auto cells =
            cells_of(row, {"scene", "machine", "workload", "level", "speedup", "mrps", "error_percent"});
        cells.emplace_back(std::max(std::abs(number_at(row, "error_percent")), least_shown_percent));
        cells.push_back(cell_of(row, "mrps_low"));
        cells.push_back(cell_of(row, "mrps_high"));
        chart.rows.push_back(cells);
    }
    chart.x = 4;
    chart.group = 3;
    chart.values = {7};
    chart.is_x_log = chart.is_y_log = true;
    chart.y_title = "error of MRPS in %";
    return chart;
}

PageChart level_mrps_chart(const Json& rows) {
    PageChart chart;
    chart.title = "MRPS by level of fidelity";
    chart.note = "Beside the table: the interval that the level itself states.";
    chart.columns = {{"Scene, machine, workload"}, {"Level"}, {"MRPS", 2}, {"From", 2}, {"To", 2},
                     {"Simulated rays"},           {"Rays"}};
    for (const Json& row : rows) {
        std::vector<PageCell> cells{fmt::format("{}, {}, {}", text_at(row, "scene"), text_at(row, "machine"),
                                                text_at(row, "workload"))};
        for (PageCell& cell :
             cells_of(row, {"level", "mrps", "mrps_low", "mrps_high", "simulated_rays", "total_rays"}))
            cells.push_back(std::move(cell));
        chart.rows.push_back(cells);
    }
    chart.group = 1;
    chart.values = {2};
    chart.y_title = "MRPS";
    return chart;
}

// Errors and speeds of the rows of each level, against every ray.
struct LevelRows {
    std::vector<double> errors, speeds;
};

std::vector<PageFinding> level_findings(const Json& rows) {
    std::map<std::string, LevelRows> levels;
    for (const Json& row : rows) {
        if (text_at(row, "level") == "cycle" || row.at("error_percent").is_null()) continue;
        LevelRows& level = levels[text_at(row, "level")];
        level.errors.push_back(std::abs(number_at(row, "error_percent")));
        level.speeds.push_back(number_at(row, "speedup"));
    }
    std::vector<PageFinding> findings;
    for (const auto& [name, level] : levels) {
        findings.push_back({name,
                            fmt::format("In the median {:.2f} % off, {:.1f} times as fast as every ray.",
                                        median_of(level.errors), median_of(level.speeds)),
                            {},
                            fmt::format("{} cases, largest error {:.2f} %", level.errors.size(),
                                        *std::ranges::max_element(level.errors))});
    }
    if (findings.empty()) {
        findings.push_back(
            {"Estimates", "They stand alone: every ray was not simulated to compare them with.", {}, {}});
    }
    return findings;
}

}  // namespace

PageSection fidelity_section(const Json& json) {
    PageSection section;
    const Json& rows = json.at("rows");
    section.title = "Fidelity";
    section.note =
        "What a level of fidelity is off by, and how much host time it saves, against simulating every ray.";
    section.findings = level_findings(rows);
    PageChart errors = level_error_chart(rows);
    if (!errors.rows.empty()) section.charts.push_back(std::move(errors));
    section.charts.push_back(level_mrps_chart(rows));
    return section;
}

}  // namespace rtu::study
