#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "model/error.hpp"
#include "study/sweep/sweep_figures.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

std::optional<double> number_of(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// The different values of a member: numbers from the least, names as they come.
std::vector<std::string> values_of(std::span<const SweepFigure> figures, std::string SweepFigure::*member) {
    std::vector<std::string> values;
    for (const SweepFigure& figure : figures) {
        if (std::ranges::find(values, figure.*member) == values.end()) values.push_back(figure.*member);
    }
    if (std::ranges::all_of(values, [](const std::string& v) { return number_of(v).has_value(); }))
        std::ranges::sort(values, {}, [](const std::string& v) { return *number_of(v); });
    return values;
}

bool is_numeric(std::span<const SweepFigure> figures) {
    return std::ranges::all_of(figures, [](const SweepFigure& f) { return number_of(f.x).has_value(); });
}

std::string y_label(const SweepChart& chart) {
    if (chart.against == SweepChart::Against::Best) return chart.y + ", % of the best";
    if (chart.against == SweepChart::Against::Nothing) return chart.y;
    std::vector<std::string> base;
    for (const auto& [column, value] : chart.base) base.push_back(value);
    return fmt::format("{}, % more than {}", chart.y, fmt::join(base, ", "));
}

// With the columns that tell the lines or bars apart, for which a legend has no room.
std::string title_of(const SweepChart& chart) {
    if (chart.series.empty()) return chart.title;
    return fmt::format("{} [{}]", chart.title, fmt::join(chart.series, ", "));
}

// Sets the points of `series`, of so many, apart from those of others on a logarithmic axis, so that their
// bars do not hide each other.
void set_apart(ChartSeries& series, std::size_t index, std::size_t count) {
    constexpr double step = 1.04;
    const double factor = std::pow(step, double(index) - 0.5 * double(count - 1));
    for (auto& point : series.points) point.first *= factor;
}

ChartSeries series_of(std::span<const SweepFigure> figures, const std::string& panel, const std::string& name,
                      const std::vector<std::string>& groups) {
    ChartSeries series;
    for (const SweepFigure& figure : figures) {
        if (figure.panel != panel || figure.series != name) continue;
        const double x = groups.empty() ? *number_of(figure.x)
                                        : double(std::ranges::find(groups, figure.x) - groups.begin());
        series.points.emplace_back(x, figure.value);
        series.spans.emplace_back(figure.least, figure.most);
    }
    // Of both in the order of x.
    std::vector<std::size_t> order(series.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return series.points[i].first; });
    ChartSeries sorted;
    for (const std::size_t i : order) {
        sorted.points.push_back(series.points[i]);
        sorted.spans.push_back(series.spans[i]);
    }
    if (std::ranges::all_of(sorted.spans, [](const auto& span) { return span.first == span.second; }))
        sorted.spans.clear();
    return sorted;
}

// A key's value alone would be a bare number; what else there is speaks for itself.
std::string panel_title(const std::string& column, const std::string& value) {
    return column.find('.') == std::string::npos ? value : fmt::format("{} = {}", column, value);
}

Chart panel_of(const SweepChart& chart, std::span<const SweepFigure> figures, const std::string& panel) {
    Chart result;
    result.name = chart.name;
    result.title = panel.empty() ? title_of(chart) : panel_title(chart.panels, panel);
    result.x_label = chart.x;
    result.y_label = y_label(chart);
    result.is_x_logarithmic = chart.is_x_logarithmic;
    result.has_zero_line = chart.against != SweepChart::Against::Best;
    if (!is_numeric(figures)) result.groups = values_of(figures, &SweepFigure::x);
    const std::vector<std::string> names = values_of(figures, &SweepFigure::series);
    for (std::size_t i = 0; i < names.size(); ++i) {
        ChartSeries series = series_of(figures, panel, names[i], result.groups);
        if (chart.is_x_logarithmic) set_apart(series, i, names.size());
        series.name = names[i];
        series.colour = i;
        result.series.push_back(std::move(series));
    }
    return result;
}

std::string cell(const SweepFigure& figure) {
    const auto text = [](double value) {
        return fmt::format("{:.{}f}", value, std::abs(value) < 10 ? 2 : 1);
    };
    if (figure.least == figure.most) return text(figure.value);
    return fmt::format("{} ({}..{})", text(figure.value), text(figure.least), text(figure.most));
}

}  // namespace

AnyChart sweep_picture(const SweepChart& chart, std::span<const SweepFigure> figures) {
    if (chart.panels.empty()) return panel_of(chart, figures, "");
    if (!is_numeric(figures))
        throw Error("chart {}: panels need an x that is a number, {} is none", chart.name, chart.x);
    ChartPanels panels{chart.name, title_of(chart), {}};
    for (const std::string& panel : values_of(figures, &SweepFigure::panel))
        panels.panels.push_back(panel_of(chart, figures, panel));
    return panels;
}

std::string sweep_figure_table(const SweepChart& chart, std::span<const SweepFigure> figures) {
    const std::string series_header = fmt::format("{}", fmt::join(chart.series, ", "));
    // The longer list of names goes down the page.
    const bool is_tall = !is_numeric(figures) && values_of(figures, &SweepFigure::x).size() >
                                                     values_of(figures, &SweepFigure::series).size();
    const auto down = is_tall ? &SweepFigure::x : &SweepFigure::series;
    const auto across = is_tall ? &SweepFigure::series : &SweepFigure::x;
    const std::vector<std::string> columns_across = values_of(figures, across);
    std::vector<TextTable::Column> columns;
    const bool has_panels = !chart.panels.empty(), has_rows = is_tall || !chart.series.empty();
    if (has_panels) columns.push_back({chart.panels, TextTable::Align::Left});
    if (has_rows) columns.push_back({is_tall ? chart.x : series_header, TextTable::Align::Left});
    for (const std::string& name : columns_across) columns.push_back({name});
    TextTable table(columns);
    for (const std::string& panel : values_of(figures, &SweepFigure::panel)) {
        for (const std::string& row : values_of(figures, down)) {
            std::vector<std::string> cells;
            if (has_panels) cells.push_back(panel);
            if (has_rows) cells.push_back(row);
            for (const std::string& name : columns_across) {
                const auto found = std::ranges::find_if(figures, [&](const SweepFigure& f) {
                    return f.panel == panel && f.*down == row && f.*across == name;
                });
                cells.push_back(found == figures.end() ? "-" : cell(*found));
            }
            table.add_row(cells);
        }
    }
    return fmt::format("{}\n{} by {}: geometric mean (least..greatest)\n\n{}", chart.title, y_label(chart),
                       is_tall && !series_header.empty() ? series_header : chart.x, table.text());
}

}  // namespace rtu::study
