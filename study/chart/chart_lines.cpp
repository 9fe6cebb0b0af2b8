#include "study/chart/chart_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "study/chart/gnuplot_text.hpp"

namespace rtu::study {
namespace {

using namespace gnuplot;

// Filled, open, and crosses: for the first, second and third time that a colour comes.
constexpr std::array point_types{7, 5, 9, 13, 11, 15, 6, 4, 8, 12, 10, 14, 1, 2, 3};

// Levels of one colour differ in their dashes: 2 to 5 in gnuplot's numbering.
std::size_t dash_of_level(const Chart& chart, const ChartSeries& level) {
    std::size_t before = 0;
    for (const ChartSeries* other = chart.series.data(); other != &level; ++other) {
        before += other->level && other->colour == level.colour ? 1 : 0;
    }
    return 2 + before % 4;
}

struct Range {
    double lo = 1e300, hi = -1e300;
    void extend(double value) {
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    }
};

Range x_range(const Chart& chart) {
    Range range;
    for (const ChartSeries& series : chart.series) {
        for (const auto& point : series.points) range.extend(point.first);
    }
    return range.lo > range.hi ? Range{1, 1} : range;
}

std::string x_axis(const Chart& chart, Range x) {
    if (!chart.is_x_logarithmic) {
        const double margin = x.lo < x.hi ? 0.03 * (x.hi - x.lo) : 1;
        return fmt::format("set xrange [{}:{}]\n", x.lo - margin, x.hi + margin);
    }
    if (chart.x_base == 10) return decimal_axis("x", x.lo / 1.15, x.hi * 1.15);
    return binary_axis("x") + fmt::format("set xrange [{}:{}]\n", x.lo / 1.15, x.hi * 1.15);
}

std::string style(const Chart& chart, const ChartSeries& series) {
    const std::string_view colour = colours[series.colour % colours.size()];
    if (series.level) {
        return fmt::format("with lines dashtype {} linewidth 1.5 linecolor rgb '{}'",
                           dash_of_level(chart, series), colour);
    }
    if (!chart.has_lines || !series.has_line) {
        return fmt::format("with points pointtype {} pointsize 0.9 linecolor rgb '{}'",
                           point_types[series.colour % point_types.size()], colour);
    }
    const std::size_t round = series.colour / colours.size();
    const std::string dash = round == 0 ? "" : fmt::format("dashtype {} ", round + 1);
    if (!chart.has_points) return fmt::format("with lines {}linewidth 2 linecolor rgb '{}'", dash, colour);
    return fmt::format("with linespoints {}linewidth 2 pointtype {} pointsize 0.7 linecolor rgb '{}'", dash,
                       point_types[series.colour % point_types.size()], colour);
}

std::vector<std::pair<double, double>> drawn_points(const Chart& chart, const ChartSeries& series, Range x) {
    if (series.level) return {{x.lo, *series.level}, {x.hi, *series.level}};
    auto points = series.points;
    if (chart.y_floor) {
        for (auto& point : points) point.second = std::max(point.second, *chart.y_floor);
    }
    return points;
}

}  // namespace

double largest_y(const Chart& chart) {
    double y = chart.y_floor.value_or(0);
    for (const ChartSeries& series : chart.series) {
        for (const auto& point : series.points) y = std::max(y, point.second);
    }
    return y;
}

std::string legend_plot(const Chart& chart) {
    std::string plots;
    for (const ChartSeries& series : chart.series) {
        plots += fmt::format("{}NaN title {} {}", plots.empty() ? "" : ", ", in_quotes(series.name),
                             style(chart, series));
    }
    return "plot " + plots + "\n";
}

std::string line_plot(const Chart& chart, std::string_view prefix, double y_most) {
    const Range x = x_range(chart);
    std::string data, plots;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const ChartSeries& series = chart.series[i];
        const std::string block = fmt::format("{}series{}", prefix, i);
        data += data_block(block, drawn_points(chart, series, x));
        plots += fmt::format("{}${} using 1:2 title {} {}", i == 0 ? "" : ", ", block, in_quotes(series.name),
                             style(chart, series));
        if (series.spans.empty()) continue;
        data += span_block(block + "spans", series.points, series.spans);
        plots += span_plot(block + "spans", colours[series.colour % colours.size()]);
    }
    return data + x_axis(chart, x) +
           (chart.y_floor ? decimal_axis_with_zero("y", *chart.y_floor, *chart.y_floor / 1.4, y_most * 1.6)
                          : "") +
           "plot " + plots + "\n";
}

}  // namespace rtu::study
