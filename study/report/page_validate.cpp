#include <fmt/format.h>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

PageChart cycle_error_chart(const Json& json) {
    PageChart chart;
    chart.title = "Error of the simulator's cycles";
    chart.note = "Against the cycles of the RTL on the same rays; hits and counts must be the same.";
    chart.columns = {{"Machine"},    {"Scene, workload"},  {"Error, %", 3},
                     {"RTL cycles"}, {"Simulator cycles"}, {"Rays"}};
    for (const Json& row : json.at("rows")) {
        chart.rows.push_back({text_at(row, "config"),
                              fmt::format("{}, {}", text_at(row, "scene"), text_at(row, "workload")),
                              cell_of(row, "error_percent"), cell_of(row, "rtl_cycles"),
                              cell_of(row, "sim_cycles"), cell_of(row, "rays")});
    }
    chart.group = 1;
    chart.values = {2};
    chart.y_title = "error in %";
    return chart;
}

PageChart rate_chart(const Json& json) {
    PageChart chart;
    chart.kind = PageChart::Kind::Points;
    chart.title = "MRPS, simulator against RTL";
    chart.note = "On the diagonal they agree.";
    chart.columns = {{"Machine"}, {"Scene"}, {"Workload"}, {"RTL, MRPS", 2}, {"Simulator, MRPS", 2}};
    for (const Json& row : json.at("rows"))
        chart.rows.push_back(cells_of(row, {"config", "scene", "workload", "rtl_mrps", "sim_mrps"}));
    chart.x = 3;
    chart.group = 2;
    chart.values = {4};
    chart.y_title = "simulator, MRPS";
    return chart;
}

}  // namespace

PageSection validate_section(const Json& json) {
    PageSection section;
    section.title = "Validation against RTL";
    const Json& summary = json.at("summary");
    if (const Json& difference = json.at("difference"); !difference.is_null()) {
        section.findings.push_back(
            {fmt::format("{}, {}, {}", text_at(difference, "scene"), text_at(difference, "workload"),
                         text_at(difference, "config")),
             "Simulator and RTL differ: " + text_at(difference, "what") + ".",
             {},
             {}});
    } else {
        section.findings.push_back(
            {"All machines",
             fmt::format("Hits and counts are the same; cycles are off by {:.2f} % at most.",
                         number_at(summary, "worst_percent")),
             {},
             fmt::format("{} runs, median error {:.2f} %, {} within 2 %, simulator {:.0f} times as fast",
                         summary.at("rows").dump(), number_at(summary, "median_percent"),
                         summary.at("within_2_percent").dump(), number_at(summary, "speedup"))});
    }
    section.charts = {cycle_error_chart(json), rate_chart(json)};
    return section;
}

}  // namespace rtu::study
