#include "study/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "model/one_line.hpp"

namespace rtu::study {
namespace {

// Okabe and Ito's colours, apart for every kind of colour vision; black and yellow left out: both are lost on
// one of the two backgrounds.
constexpr std::array<std::string_view, 6> colours{"#0072b2", "#d55e00", "#009e73",
                                                  "#cc79a7", "#56b4e9", "#e69f00"};
constexpr std::array point_types{7, 5, 9, 13, 11, 15};
constexpr int least_width = 760;
constexpr int least_height = 400;
constexpr int key_row_height = 20;  // a legend taller than the chart would be cut

// Nothing is expanded within single quotes. A quote would end them (gnuplot 5.4 reads a doubled one wrongly
// at the beginning of a text), so it becomes an apostrophe; bytes that are no UTF-8 become replacement
// characters.
std::string in_quotes(std::string_view text) {
    using Json = nlohmann::json;
    const std::string valid =
        Json::parse(Json(model::printable(text)).dump(-1, ' ', false, Json::error_handler_t::replace));
    std::string out = "'";
    for (const char c : valid) {
        if (c == '\'') {
            out += "\u2019";
        } else {
            out += c;
        }
    }
    return out + "'";
}

std::string data_block(std::string_view name, const std::vector<std::pair<double, double>>& points) {
    std::string out = fmt::format("${} << END\n", name);
    for (const auto& [x, y] : points) out += fmt::format("{} {}\n", x, y);
    return out + "END\n";
}

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

std::string terminal(const Chart& chart, ChartFormat format) {
    if (format == ChartFormat::Png) {
        return fmt::format("set terminal pngcairo noenhanced background 'white' size {},{} font 'sans,12'\n",
                           width_of(chart), height_of(chart));
    }
    return fmt::format(
        "set terminal svg noenhanced background 'white' size {},{} dynamic font 'sans-serif,14' name {}\n",
        width_of(chart), height_of(chart), in_quotes(chart.name));
}

// The title is a label: gnuplot centres titles over the plot, and beside a wide legend a long one would be
// cut.
std::string frame(const Chart& chart) {
    std::string out = fmt::format(
        "set encoding utf8\nset label 1 {} at screen 0.02, screen 0.955 left\nset tmargin 3\nset xlabel "
        "{}\nset ylabel {}\n"
        "set key outside right top vertical Left reverse samplen 1.5\n"
        "set grid ytics linewidth 0.5 linecolor rgb '#999999'\n"
        "set border 3 linecolor rgb '#808080'\nset tics nomirror textcolor rgb 'black'\n",
        in_quotes(chart.title), in_quotes(chart.x_label), in_quotes(chart.y_label));
    if (chart.is_x_logarithmic) out += "set logscale x 2\nset format x '%g'\n";
    if (chart.has_zero_line) out += "set yrange [*<0:0<*]\n";
    return out;
}

// Levels of one colour differ in their dashes: 2 to 5 in gnuplot's numbering.
std::size_t dash_type(const Chart& chart, const ChartSeries& level) {
    std::size_t before = 0;
    for (const ChartSeries* other = chart.series.data(); other != &level; ++other) {
        before += other->level && other->colour == level.colour ? 1 : 0;
    }
    return 2 + before % 4;
}

// Lines: each series its own colour and kind of point; levels dashed.
std::string lines(const Chart& chart) {
    std::string data, plots;
    double lo = 1e300, hi = -1e300;
    for (const ChartSeries& series : chart.series) {
        for (const auto& point : series.points) {
            lo = std::min(lo, point.first);
            hi = std::max(hi, point.first);
        }
    }
    if (lo > hi) lo = hi = 1;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const ChartSeries& series = chart.series[i];
        const std::string block = fmt::format("series{}", i);
        const std::string_view colour = colours[series.colour % colours.size()];
        auto points = series.points;
        if (series.level) points = {{lo, *series.level}, {hi, *series.level}};
        data += data_block(block, points);
        plots += fmt::format("{}${} using 1:2 title {} ", i == 0 ? "" : ", ", block, in_quotes(series.name));
        plots +=
            series.level
                ? fmt::format("with lines dashtype {} linewidth 1.5 linecolor rgb '{}'",
                              dash_type(chart, series), colour)
                : fmt::format("with linespoints linewidth 2 pointtype {} pointsize 0.7 linecolor rgb '{}'",
                              point_types[series.colour % point_types.size()], colour);
    }
    const std::string range =
        chart.is_x_logarithmic
            ? fmt::format("set xrange [{}:{}]\n", lo / 1.15, hi * 1.15)
            : fmt::format("set xrange [{}:{}]\n", lo - 0.03 * (hi - lo), hi + 0.03 * (hi - lo));
    return data + range + "plot " + plots + "\n";
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
    }
    plots += ", 0 notitle with lines linewidth 1 linecolor rgb '#808080'";
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
    std::string out = terminal(chart, format) + frame(chart);
    if (!has_data(chart)) return out + "set xrange [0:1]\nset yrange [0:1]\nplot NaN title 'no data'\n";
    return out + (chart.groups.empty() ? lines(chart) : bars(chart));
}

}  // namespace rtu::study
