#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/chart/html_page.hpp"
#include "study/stream/stream_output.hpp"

namespace rtu::study {
namespace {

std::vector<std::pair<double, double>> points_of(const StreamReport& report, const std::string& mode,
                                                 const std::string& link) {
    std::vector<std::pair<double, double>> points;
    for (const StreamRow& row : report.rows) {
        if (row.mode == mode && row.link == link)
            points.emplace_back(double(row.batch_tests), row.tests_per_second() / 1e6);
    }
    std::ranges::sort(points);
    return points;
}

// Where testers and link balance, one point a link.
ChartSeries balance_series(const StreamReport& report, const std::string& mode) {
    ChartSeries series;
    series.name = "balance";
    series.has_line = false;
    for (const StreamBalance& balance : report.balances) {
        if (balance.mode != mode || !balance.batch_tests) continue;
        for (const StreamRow& row : report.rows) {
            if (row.mode == mode && row.link == balance.link && row.batch_tests == *balance.batch_tests)
                series.points.emplace_back(double(row.batch_tests), row.tests_per_second() / 1e6);
        }
    }
    std::ranges::sort(series.points);
    return series;
}

// A power of ten well below every value, where the axis says 0.
double floor_below(const std::vector<ChartSeries>& all) {
    double least = std::numeric_limits<double>::max();
    for (const ChartSeries& series : all)
        for (const auto& [x, y] : series.points) least = std::min(least, y);
    return std::pow(10.0, std::floor(std::log10(least)) - 1);
}

Chart mode_chart(const StreamReport& report, const std::string& mode) {
    Chart chart;
    chart.name = "stream_" + mode;
    chart.title = mode;
    chart.x_label = "batch, pair tests";
    chart.y_label = "million triangle tests a second";
    chart.is_x_logarithmic = true;
    chart.x_base = 10;
    for (const std::string& link : report.links) {
        ChartSeries series;
        series.name = link;
        series.points = points_of(report, mode, link);
        series.colour = chart.series.size();
        chart.series.push_back(std::move(series));
    }
    ChartSeries balance = balance_series(report, mode);
    balance.colour = chart.series.size();
    if (!balance.points.empty()) chart.series.push_back(std::move(balance));
    chart.y_floor = floor_below(chart.series);
    return chart;
}

bool has_curve(const Chart& chart) {
    return std::ranges::any_of(chart.series, [](const ChartSeries& s) { return s.points.size() > 1; });
}

std::string table_html(const StudyTable& table) {
    std::string out =
        fmt::format("<h2>{}</h2>\n{}", html_escaped(table.title), html_table(table.columns, table.rows));
    if (!table.note.empty()) out += fmt::format("<p class=\"note\">{}</p>\n", html_escaped(table.note));
    return out;
}

}  // namespace

std::vector<AnyChart> stream_charts(const StreamReport& report) {
    std::vector<AnyChart> charts;
    std::vector<std::string> seen;
    for (const StreamRow& row : report.rows) {
        if (std::ranges::find(seen, row.mode) != seen.end()) continue;
        seen.push_back(row.mode);
        Chart chart = mode_chart(report, row.mode);
        chart.title = fmt::format("Streaming without a BVH, {}: rate against batch size", row.mode);
        if (has_curve(chart)) charts.emplace_back(std::move(chart));
    }
    return charts;
}

std::string stream_html(const StreamReport& report) {
    std::string body = fmt::format("<pre>{}</pre>\n", html_escaped(stream_facts(report)));
    std::string figures;
    for (const AnyChart& chart : stream_charts(report))
        figures += html_figure(draw(chart, ChartFormat::Svg), name_of(chart));
    for (const StudyTable& table : stream_tables(report)) {
        body += table_html(table) + figures;  // the charts follow the first table
        figures.clear();
    }
    return html_page("Rays and triangles over a host link", body);
}

}  // namespace rtu::study
