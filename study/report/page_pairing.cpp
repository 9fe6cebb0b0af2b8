#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

std::string row_name(const Json& row) {
    return fmt::format("{}, {}", text_at(row, "scene"), text_at(row, "method"));
}

PageChart change_chart(const Json& json, const std::string& title, const std::string& note,
                       const std::vector<std::pair<std::string, std::string>>& columns) {
    PageChart chart;
    chart.title = title;
    chart.note = note;
    chart.columns = {{"Scene, method"}};
    for (const auto& [key, name] : columns) {
        chart.values.push_back(chart.columns.size());
        chart.columns.push_back({name, 2});
    }
    for (const Json& row : json.at("rows")) {
        auto& cells = chart.rows.emplace_back(std::vector<PageCell>{row_name(row)});
        for (const auto& [key, name] : columns) cells.push_back(cell_of(row, key));
    }
    chart.y_title = "change in %";
    return chart;
}

PageChart paired_chart(const Json& json) {
    PageChart chart;
    chart.title = "Triangles in pairs";
    chart.note = fmt::format("Of all triangles, with the baseline ({}) and with each method.",
                             text_at(json, "baseline"));
    chart.columns = {{"Scene, method"}, {"Baseline", 2}, {"Method", 2}};
    for (const Json& row : json.at("rows")) {
        chart.rows.push_back(
            {row_name(row), cell_of(row, "old_paired_percent"), cell_of(row, "new_paired_percent")});
    }
    chart.values = {1, 2};
    chart.y_title = "% of the triangles";
    return chart;
}

std::vector<PageCell> study_cells(const Json& row) {
    const Json& after = row.at("new");
    const double rays = number_at(after, "ray_count");
    const auto a_ray = [&](const char* key) {
        return cell_of(rays > 0 ? std::optional(number_at(after, key) / rays) : std::nullopt);
    };
    return {text_at(row, "setting"),
            text_at(row, "scene"),
            row_name(row),
            cell_of(row, "x"),
            cell_of(row.at("old"), "mrps"),
            cell_of(after, "mrps"),
            a_ray("l1_misses"),
            a_ray("l2_misses"),
            a_ray("dram_bytes"),
            cell_of(row, "delta_mrps_percent")};
}

// Over a number, or in clusters where the settings are names.
PageChart study_chart(const Json& study, const std::string& what, std::size_t value) {
    PageChart chart;
    const std::string axis = text_at(study, "axis");
    chart.title = fmt::format("Study {}: {}", text_at(study, "name"), what);
    chart.note = text_at(study, "meaning") + ".";
    chart.columns = {{"Setting"},
                     {"Scene"},
                     {"Scene, method"},
                     {axis.empty() ? "Setting, number" : axis, 2},
                     {"MRPS, baseline", 2},
                     {"MRPS", 2},
                     {"L1 misses a ray", 3},
                     {"L2 misses a ray", 3},
                     {"DRAM bytes a ray", 1},
                     {"MRPS, change in %", 2}};
    bool is_number = false;
    for (const Json& row : study.at("rows")) {
        chart.rows.push_back(study_cells(row));
        is_number = is_number || !row.at("x").is_null();
    }
    chart.kind = is_number ? PageChart::Kind::Lines : PageChart::Kind::Bars;
    chart.x = is_number ? 3 : 0;
    // Sizes and rates grow by factors.
    chart.is_x_log = is_number && text_at(study, "name") != "rotation";
    // There the setting is the method.
    chart.group = text_at(study, "name") == "window" ? 1 : 2;
    chart.values = {value};
    chart.y_title = chart.columns[value].name;
    return chart;
}

PageFinding average_finding(const Json& average) {
    const auto change = [&](const char* key) {
        const Json& value = average.at(key);
        return value.is_null() ? std::string("unknown") : fmt::format("{:+.1f} %", value.get<double>());
    };
    PageFinding found;
    found.subject = fmt::format("{} against {}", text_at(average, "method"), text_at(average, "baseline"));
    const Json& mrps = average.at("delta_mrps_percent");
    found.text =
        mrps.is_null() ? "Nothing to compare."
        : std::abs(mrps.get<double>()) < 1
            ? "The pairing changes the rate by less than 1 %."
            : fmt::format("Pairing this way makes the machine {} by {:.1f} %.",
                          mrps.get<double>() > 0 ? "faster" : "slower", std::abs(mrps.get<double>()));
    found.figures = fmt::format("box tests {}, pair tests {}, MRPS {}, DRAM bytes {}; mean over the scenes",
                                change("delta_box_percent"), change("delta_tri_percent"),
                                change("delta_mrps_percent"), change("delta_dram_bytes_percent"));
    return found;
}

}  // namespace

PageSection pairing_section(const Json& json) {
    PageSection section;
    section.title = "Pairing";
    section.note = fmt::format("Pairings against {}, machine {}, rtusim {}.", text_at(json, "baseline"),
                               text_at(json, "preset"), text_at(json, "version"));
    for (const Json& average : json.at("averages")) section.findings.push_back(average_finding(average));
    section.charts = {change_chart(json, "What the pairing changes",
                                   "Against the baseline; fewer tests and more MRPS are better.",
                                   {{"delta_box_percent", "Box tests"},
                                    {"delta_tri_percent", "Pair tests"},
                                    {"delta_mrps_percent", "MRPS"}}),
                      change_chart(json, "What it changes in memory", "Against the baseline; less is better.",
                                   {{"delta_image_bytes_percent", "Image bytes"},
                                    {"delta_l1_misses_percent", "L1 misses"},
                                    {"delta_l2_misses_percent", "L2 misses"},
                                    {"delta_dram_bytes_percent", "DRAM bytes"}}),
                      paired_chart(json)};
    for (const Json& study : json.at("studies")) {
        section.charts.push_back(study_chart(study, "MRPS", 5));
        const std::string name = text_at(study, "name");
        if (name == "l1_size") section.charts.push_back(study_chart(study, "misses of the L1", 6));
        if (name == "l2_size") section.charts.push_back(study_chart(study, "misses of the L2", 7));
        if (name == "l2_size") section.charts.push_back(study_chart(study, "DRAM traffic", 8));
    }
    return section;
}

}  // namespace rtu::study
