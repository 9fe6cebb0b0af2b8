#include "study/validate/validate_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "study/chart/html_page.hpp"
#include "study/json_output.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

Json json(const ValidateRow& row) {
    return {{"scene", row.scene},
            {"workload", row.workload},
            {"config", row.config},
            {"rays", row.rays},
            {"hits", row.hits},
            {"rtl_cycles", row.rtl_cycles},
            {"sim_cycles", row.sim_cycles},
            {"side_tests", row.side_tests},
            {"error_percent", row.error_percent()},
            {"rtl_mrps", mrps(row.rays, row.rtl_cycles, row.clock_mhz)},
            {"sim_mrps", mrps(row.rays, row.sim_cycles, row.clock_mhz)},
            {"rtl_rays_per_second", row.rtl_rays_per_second()},
            {"sim_rays_per_second", row.sim_rays_per_second()}};
}

Json json(const std::optional<ValidateDifference>& difference) {
    if (!difference) return nullptr;
    return {{"scene", difference->scene},
            {"workload", difference->workload},
            {"config", difference->config},
            {"ray", difference->ray ? Json(*difference->ray) : Json(nullptr)},
            {"what", difference->what}};
}

std::string heading(const ValidateReport& report) {
    const std::string changes =
        report.sim_sets.empty() ? "" : fmt::format(" with {}", fmt::join(report.sim_sets, " "));
    return fmt::format("rtusim {}  simulator{} against the Verilated RTU  seed {}", report.version, changes,
                       report.seed);
}

}  // namespace

std::string validate_text(const ValidateReport& report) {
    std::string out = fmt::format("{}\n\n{}\n", heading(report), validate_answer(report));
    for (const StudyTable& table : validate_tables(report)) {
        TextTable text(table.columns);
        for (const auto& row : table.rows) row.empty() ? text.add_rule() : text.add_row(row);
        out += fmt::format("\n{}\n{}", table.title, text.text());
        if (!table.note.empty()) out += table.note + "\n";
    }
    return out;
}

std::string validate_json(const ValidateReport& report) {
    const ErrorSummary summary = error_summary(report.rows);
    Json document{{"version", report.version},
                  {"seed", report.seed},
                  {"sim_sets", report.sim_sets},
                  {"summary",
                   {{"rows", summary.rows},
                    {"worst_percent", summary.worst_percent},
                    {"median_percent", summary.median_percent},
                    {"within_2_percent", summary.within_2_percent},
                    {"without_side_tests", exact_rows(report.rows).without_side_tests},
                    {"exact_without_side_tests", exact_rows(report.rows).exact},
                    {"speedup", speedup(report.rows)}}},
                  {"difference", json(report.difference)}};
    for (const char* key : {"configs", "rows"}) document[key] = Json::array();
    for (const ValidateConfig& config : report.configs) {
        document["configs"].push_back({{"name", config.name}, {"sets", config.sets}});
    }
    for (const ValidateRow& row : report.rows) document["rows"].push_back(json(row));
    return json_text(document);
}

std::string validate_csv(const ValidateReport& report) {
    std::vector<Json> rows;
    for (const ValidateRow& row : report.rows) rows.push_back(json(row));
    return json_rows_csv(json(ValidateRow{}), rows);
}

std::string validate_html(const ValidateReport& report) {
    std::string body = fmt::format("<p class=\"note\">{}</p>\n<p>{}</p>\n", html_escaped(heading(report)),
                                   html_escaped(validate_answer(report)));
    for (const AnyChart& chart : validate_charts(report)) {
        body += html_figure(draw(chart, ChartFormat::Svg), name_of(chart));
    }
    for (const StudyTable& table : validate_tables(report)) {
        body +=
            fmt::format("<h2>{}</h2>\n{}", html_escaped(table.title), html_table(table.columns, table.rows));
        if (!table.note.empty()) body += fmt::format("<p class=\"note\">{}</p>\n", html_escaped(table.note));
    }
    return html_page("The simulator against the RTL", body);
}

}  // namespace rtu::study
