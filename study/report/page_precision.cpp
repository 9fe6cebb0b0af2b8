#include <fmt/format.h>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

PageChart area_chart(const Json& json, const std::string& scene) {
    PageChart chart;
    chart.kind = PageChart::Kind::Points;
    chart.title = fmt::format("{}: wrong rays against area", scene);
    chart.note =
        "A point is a method in a number format; down and to the left is better. Points without a wrong ray "
        "are on the bottom line, drawn at a tenth of a ray.";
    chart.columns = {{"Method"},      {"Format"}, {"Area, binary32 multipliers", 2},
                     {"Wrong rays"},  {"Rays"},   {"Wrong per million, drawn", 0},
                     {"Exact enough"}};
    for (const Json& row : json.at("rows")) {
        if (text_at(row, "scene") != scene || row.at("area").is_null()) continue;
        const double rays = number_at(row, "rays"), wrong = number_at(row, "wrong_rays");
        if (rays == 0) continue;
        chart.rows.push_back({text_at(row, "method"), text_at(row, "format"), cell_of(row, "area"), wrong,
                              rays, 1e6 * std::max(wrong, 0.1) / rays,
                              row.at("is_enough").get<bool>() ? "yes" : "no"});
    }
    chart.x = 2;
    chart.group = 0;
    chart.values = {5};
    chart.is_x_log = chart.is_y_log = true;
    chart.y_title = "wrong rays per million";
    return chart;
}

PageChart filter_chart(const Json& json) {
    PageChart chart;
    chart.kind = PageChart::Kind::Lines;
    chart.title = "Filter in few bits";
    chart.note = "Missed tests that a conservative test in a narrow format passes on, of all missed ones.";
    chart.columns = {{"Scene"},           {"Format"}, {"Mantissa bits"}, {"False positives, %", 2},
                     {"False negatives"}, {"Area", 2}};
    for (const Json& row : json.at("filters")) {
        chart.rows.push_back(cells_of(
            row, {"scene", "format", "mantissa_bits", "false_positive_percent", "false_negatives", "area"}));
    }
    chart.x = 2;
    chart.group = 0;
    chart.values = {3};
    chart.y_title = "% false positives";
    return chart;
}

PageFinding answer(const Json& json) {
    PageFinding found;
    found.subject = text_at(json, "scene");
    const Json& row = json.at("row");
    if (row.is_null()) {
        found.text =
            "No method and format can be called exact enough: there are too few rays, or all are off.";
    } else {
        found.text = fmt::format("{} in {} is the cheapest that is exact enough.", text_at(row, "method"),
                                 text_at(row, "format"));
        found.figures =
            fmt::format("{:.0f} wrong of {:.0f} rays, area {:.2f} binary32 multipliers",
                        number_at(row, "wrong_rays"), number_at(row, "rays"), number_at(row, "area"));
    }
    return found;
}

}  // namespace

PageSection precision_section(const Json& json) {
    PageSection section;
    section.title = "Precision";
    section.note = fmt::format(
        "Wrong: more than {:.3g} off in t, another triangle, or a lost or invented hit. Asked for: at most "
        "{:.0f} "
        "wrong rays per million.",
        number_at(json, "t_tolerance"), number_at(json, "wrong_per_million"));
    for (const Json& one : json.at("answers")) {
        section.findings.push_back(answer(one));
        section.charts.push_back(area_chart(json, text_at(one, "scene")));
    }
    if (!json.at("filters").empty()) section.charts.push_back(filter_chart(json));
    return section;
}

}  // namespace rtu::study
