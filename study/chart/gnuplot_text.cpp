#include "study/chart/gnuplot_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/one_line.hpp"

namespace rtu::study::gnuplot {

// A quote would end the text (gnuplot 5.4 reads a doubled one wrongly at the beginning of a text), so it
// becomes an apostrophe; bytes that are no UTF-8 become replacement characters.
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

std::string span_block(std::string_view name, const std::vector<std::pair<double, double>>& points,
                       const std::vector<std::pair<double, double>>& spans) {
    std::string out = fmt::format("${} << END\n", name);
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const auto& [least, most] = spans[i];
        if (least < most) out += fmt::format("{} {} {}\n", points[i].first, least, most - least);
    }
    return out + "END\n";
}

std::string span_plot(std::string_view name, std::string_view colour) {
    return fmt::format(
        ", ${} using 1:2:(0):3 notitle with vectors heads size screen 0.003,90 linewidth 1 linecolor rgb "
        "'{}'",
        name, colour);
}

std::string terminal(ChartFormat format, PixelSize size, std::string_view name) {
    if (format == ChartFormat::Png) {
        return fmt::format("set terminal pngcairo noenhanced background 'white' size {},{} font 'sans,12'\n",
                           size.width, size.height);
    }
    return fmt::format(
        "set terminal svg noenhanced background 'white' size {},{} dynamic font 'sans-serif,14' name {}\n",
        size.width, size.height, in_quotes(name));
}

std::string title(std::string_view text) {
    return fmt::format("set encoding utf8\nset label 1 {} at screen 0.02, screen 0.955 left\nset tmargin 3\n",
                       in_quotes(text));
}

std::string axes() {
    return "set grid ytics linewidth 0.5 linecolor rgb '#999999'\n"
           "set border 3 linecolor rgb '#808080'\nset tics nomirror textcolor rgb 'black'\n";
}

std::string binary_axis(std::string_view axis) {
    return fmt::format("set logscale {0} 2\nset format {0} '%g'\n", axis);
}

namespace {

std::string decade_name(double value) {
    return value < 99'999
               ? fmt::format("{:g}", value)
               : fmt::format("{:g}e{}", value / std::pow(10.0, std::floor(std::log10(value * 1.01))),
                             int(std::floor(std::log10(value * 1.01))));
}

std::string tics_between(double lo, double hi, double above) {
    const bool is_short = hi / lo < 200;
    std::string out;
    for (int decade = int(std::floor(std::log10(lo))); decade <= int(std::ceil(std::log10(hi))); ++decade) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, decade);
            if ((digit != 1 && !is_short) || value < lo || value > hi || value <= above) continue;
            out += fmt::format("{}'{}' {:g}", out.empty() ? "" : ", ", decade_name(value), value);
        }
    }
    return out;
}

std::string decimal(std::string_view axis, const std::string& tics, double lo, double hi) {
    return fmt::format("set logscale {0} 10\nset {0}range [{1:g}:{2:g}]\nset {0}tics ({3})\n", axis, lo, hi,
                       tics);
}

}  // namespace

std::string decimal_axis(std::string_view axis, double lo, double hi) {
    return decimal(axis, tics_between(lo, hi, 0), lo, hi);
}

std::string decimal_axis_with_zero(std::string_view axis, double floor, double lo, double hi) {
    const std::string more = tics_between(lo, hi, floor * 1.5);
    return decimal(axis, fmt::format("'0' {:g}{}{}", floor, more.empty() ? "" : ", ", more), lo, hi);
}

}  // namespace rtu::study::gnuplot
