#include "study/chart/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "study/chart/chart_lines.hpp"
#include "study/chart/gnuplot_text.hpp"

namespace rtu::study {
namespace {

using namespace gnuplot;

constexpr int least_width = 760;
constexpr int least_height = 400;
constexpr int key_row_height = 20;  // a legend taller than the chart would be cut

bool has_data(const Chart& chart) {
    return std::ranges::any_of(chart.series,
                               [](const ChartSeries& s) { return !s.points.empty() || s.level; });
}

// Names of groups that would overlap when written side by side.
bool has_slanted_names(const Chart& chart) {
    std::size_t characters = 0;
    for (const std::string& group : chart.groups) characters += group.size() + 3;
    return characters > 50;
}

int width_of(const Chart& chart) { return chart.groups.size() > 8 ? least_width + 200 : least_width; }

int height_of(const Chart& chart) {
    const auto rows = int(chart.series.size()) + (chart.mark_name.empty() ? 0 : 1);
    return std::max(least_height + (has_slanted_names(chart) ? 80 : 0), 110 + rows * key_row_height);
}

std::string frame(const Chart& chart) {
    std::string out =
        title(chart.title) +
        fmt::format("set xlabel {}\nset ylabel {}\n", in_quotes(chart.x_label), in_quotes(chart.y_label)) +
        "set key outside right top vertical Left reverse samplen 1.5\n" + axes();
    if (chart.has_zero_line) out += "set yrange [*<0:0<*]\n";
    return out;
}

std::string group_tics(const Chart& chart) {
    std::string out = "set xtics (";
    for (std::size_t i = 0; i < chart.groups.size(); ++i) {
        out += fmt::format("{}{} {}", i == 0 ? "" : ", ", in_quotes(chart.groups[i]), i);
    }
    return out + (has_slanted_names(chart) ? ") rotate by -35 left\n" : ")\n");
}

// Bars: the groups side by side, in each a bar of every series.
std::string bars(const Chart& chart) {
    const double bar = 0.8 / double(chart.series.size());
    std::string data, plots;
    std::string spans;
    std::vector<std::pair<double, double>> marks;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const double shift = (double(i) - 0.5 * double(chart.series.size() - 1)) * bar;
        const auto shifted = [shift](std::vector<std::pair<double, double>> points) {
            for (auto& point : points) point.first += shift;
            return points;
        };
        data += data_block(fmt::format("series{}", i), shifted(chart.series[i].points));
        const auto more = shifted(chart.series[i].marks);
        marks.insert(marks.end(), more.begin(), more.end());
        plots += fmt::format(
            "{}$series{} using 1:2:({}) title {} with boxes fillstyle solid noborder linecolor rgb '{}'",
            i == 0 ? "" : ", ", i, bar * 0.92, in_quotes(chart.series[i].name),
            colours[chart.series[i].colour % colours.size()]);
        if (chart.series[i].spans.empty()) continue;
        const std::string name = fmt::format("spans{}", i);
        data += span_block(name, shifted(chart.series[i].points), chart.series[i].spans);
        spans += span_plot(name, "black");
    }
    plots += spans + ", 0 notitle with lines linewidth 1 linecolor rgb '#808080'";
    if (!marks.empty()) {
        data += data_block("marks", marks);
        plots += fmt::format(
            ", $marks using 1:2 title {} with points pointtype 12 pointsize 0.8 linewidth 2 linecolor rgb "
            "'black'",
            in_quotes(chart.mark_name));
    }
    return data + group_tics(chart) +
           fmt::format("set xrange [-0.6:{}]\n", double(chart.groups.size()) - 0.4) + "plot " + plots + "\n";
}

}  // namespace

std::string gnuplot_script(const Chart& chart, ChartFormat format) {
    std::string out = terminal(format, {width_of(chart), height_of(chart)}, chart.name) + frame(chart);
    if (!has_data(chart)) return out + "set xrange [0:1]\nset yrange [0:1]\nplot NaN title 'no data'\n";
    return out + (chart.groups.empty() ? line_plot(chart, "", largest_y(chart)) : bars(chart));
}

std::string draw(const Chart& chart, ChartFormat format) {
    return run_gnuplot_script(gnuplot_script(chart, format), chart.name);
}

}  // namespace rtu::study
