#include <fmt/format.h>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

PageChart speed_chart(const Json& json, const std::string& workload) {
    PageChart chart;
    chart.title = fmt::format("Tests a second, {}", workload);
    chart.note =
        "One thread of the host that measured. single: one ray, one triangle; rays, triangles, pairs: so "
        "many at once.";
    chart.columns = {{"Method"},
                     {"Form"},
                     {"Million tests a second", 1},
                     {"Of nearest hits at worst", 1},
                     {"Cycles a test", 1}};
    for (const Json& row : json.at("rows")) {
        if (text_at(row, "workload") != workload) continue;
        const auto width = row.at("width").get<std::uint64_t>();
        const std::string form =
            width == 1 ? text_at(row, "form") : fmt::format("{} x {}", text_at(row, "form"), width);
        chart.rows.push_back({text_at(row, "method"), form, cell_of(row, "mtests_per_second"),
                              cell_of(row, "worst_mtests_per_second"), cell_of(row, "cycles_per_test")});
    }
    chart.group = 1;
    chart.values = {2};
    chart.y_title = "million tests a second";
    return chart;
}

PageChart operations_chart(const Json& json) {
    PageChart chart;
    chart.kind = PageChart::Kind::Stack;
    chart.title = "Operations of a hit";
    chart.note = "Of one triangle that is hit, with t, u and v.";
    chart.columns = {{"Method"}, {"Multiplications"}, {"Additions"}, {"Divisions"}, {"Comparisons"}};
    for (const Json& row : json.at("operations")) {
        const Json& hit = row.at("hit");
        chart.rows.push_back({text_at(row, "method"), cell_of(hit, "mul"), cell_of(hit, "add"),
                              cell_of(hit, "div"), cell_of(hit, "compare")});
    }
    chart.values = {1, 2, 3, 4};
    chart.y_title = "operations";
    return chart;
}

// The rows are many: the fastest of each form says most.
PageFinding fastest(const PageChart& speeds, const std::string& workload) {
    std::vector<std::string> forms;
    std::vector<const std::vector<PageCell>*> best;
    for (const auto& row : speeds.rows) {
        const auto& form = std::get<std::string>(row[1]);
        const auto at = std::size_t(std::ranges::find(forms, form) - forms.begin());
        if (at == forms.size()) {
            forms.push_back(form);
            best.push_back(&row);
        } else if (std::get<double>(row[2]) > std::get<double>((*best[at])[2])) {
            best[at] = &row;
        }
    }
    std::string text, figures;
    for (std::size_t i = 0; i < forms.size(); ++i) {
        const char* before = i == 0 ? "" : ", ";
        text += fmt::format("{}{} ({})", before, std::get<std::string>((*best[i])[0]), forms[i]);
        figures += fmt::format("{}{}: {:.1f}", before, forms[i], std::get<double>((*best[i])[2]));
    }
    return {workload, fmt::format("Fastest: {}.", text), {}, figures + " million tests a second"};
}

}  // namespace

PageSection methods_section(const Json& json) {
    PageSection section;
    section.title = "Ray-triangle methods";
    section.note = fmt::format("Measured on a host with {}, the least time of {} repeats.",
                               text_at(json, "instruction_set"), json.at("repeats").get<std::uint64_t>());
    std::vector<std::string> workloads;
    for (const Json& row : json.at("rows")) {
        const std::string name = text_at(row, "workload");
        if (std::ranges::find(workloads, name) == workloads.end()) workloads.push_back(name);
    }
    for (const std::string& workload : workloads) {
        section.charts.push_back(speed_chart(json, workload));
        section.findings.push_back(fastest(section.charts.back(), workload));
    }
    section.charts.push_back(operations_chart(json));
    return section;
}

}  // namespace rtu::study
