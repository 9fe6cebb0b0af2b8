#include "study/pairing/pairing_html.hpp"

#include <fmt/format.h>

#include "study/chart/html_page.hpp"
#include "study/pairing/pairing_charts.hpp"
#include "study/pairing/pairing_tables.hpp"
#include "study/pairing/pairing_text.hpp"

namespace rtu::study {
namespace {

std::string section(const PairingTable& table) {
    std::string out =
        fmt::format("<h2>{}</h2>\n{}", html_escaped(table.title), html_table(table.columns, table.rows));
    if (!table.note.empty()) out += fmt::format("<p class=\"note\">{}</p>\n", html_escaped(table.note));
    return out;
}

std::string figures(const std::vector<Chart>& charts) {
    std::string out;
    for (const Chart& chart : charts) {
        out += html_figure(draw(chart, ChartFormat::Svg), chart.name);
    }
    return out;
}

}  // namespace

std::string pairing_html(const PairingReport& report) {
    std::string body = fmt::format("<pre>{}</pre>\n", html_escaped(pairing_facts(report)));
    std::string charts = figures(comparison_charts(report));
    for (const PairingTable& table : comparison_tables(report)) {
        body += section(table) + charts;  // the charts follow the first table
        charts.clear();
    }
    for (const PairingStudyTable& study : report.studies) {
        body += section(study_table(report, study)) + figures(study_charts(report, study));
    }
    return html_page("What triangle pairing does to the hardware", body);
}

std::vector<Chart> pairing_charts(const PairingReport& report) {
    std::vector<Chart> charts = comparison_charts(report);
    for (const PairingStudyTable& study : report.studies) {
        const std::vector<Chart> more = study_charts(report, study);
        charts.insert(charts.end(), more.begin(), more.end());
    }
    return charts;
}

}  // namespace rtu::study
