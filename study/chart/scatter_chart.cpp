#include "study/chart/scatter_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "study/chart/gnuplot_text.hpp"

namespace rtu::study {
namespace {

using namespace gnuplot;

constexpr PixelSize size{960, 600};
// The plot within the picture, in pixels from the lower left.
constexpr double plot_left = 90, plot_right = 800, plot_bottom = 70, plot_top = 540;
constexpr double line_height = 16;

// Generous: letters differ.
double name_width(std::size_t characters) { return 8 * double(characters) + 10; }

struct Axis {
    double lo = 0, hi = 1;
    bool is_logarithmic = false;
    // 0 at the low end, 1 at the high one.
    [[nodiscard]] double share(double value) const {
        if (is_logarithmic) return std::log(value / lo) / std::log(hi / lo);
        return (value - lo) / (hi - lo);
    }
};

template <class Member>
Axis axis_of(const std::vector<ScatterPoint>& points, Member member, bool is_logarithmic) {
    const auto [least, most] = std::ranges::minmax_element(points, {}, member);
    const double lo = (*least).*member, hi = (*most).*member;
    if (is_logarithmic) return {lo / 1.5, hi * 1.5, true};
    const double gap = hi > lo ? 0.08 * (hi - lo) : 1;
    return {lo - gap, hi + gap, false};
}

struct Box {
    double left, bottom, right, top;
    [[nodiscard]] bool meets(const Box& other) const {
        return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
    }
};

struct Place {
    double x, y;  // pixels
};

// Names to the right of their points, or above, below, left, farther and farther, where nothing is yet.
class NamePlaces {
  public:
    explicit NamePlaces(const std::vector<Place>& points) {
        for (const Place p : points) taken_.push_back({p.x - 7, p.y - 7, p.x + 7, p.y + 7});
    }
    Place put(Place point, std::size_t characters) {
        const double width = name_width(characters);
        for (double distance = 0; distance < 260; distance += 4) {
            for (const auto& [dx, dy] : directions_) {
                const Place at{point.x + 11 + dx * distance - (dx < 0 ? width + 22 : 0),
                               point.y + dy * distance};
                const Box box{at.x, at.y - line_height / 2, at.x + width, at.y + line_height / 2};
                if (is_free(box)) {
                    taken_.push_back(box);
                    return at;
                }
            }
        }
        return {point.x + 11, point.y};
    }

  private:
    [[nodiscard]] bool is_free(const Box& box) const {
        if (box.left < plot_left || box.right > plot_right || box.bottom < plot_bottom || box.top > plot_top)
            return false;
        return std::ranges::none_of(taken_, [&](const Box& other) { return box.meets(other); });
    }
    static constexpr std::array<std::pair<double, double>, 8> directions_{
        {{1, 0}, {0.7, 0.7}, {0.7, -0.7}, {-1, 0}, {0, 1}, {0, -1}, {-0.7, 0.7}, {-0.7, -0.7}}};
    std::vector<Box> taken_;
};

std::string names(const ScatterChart& chart, const Axis& x, const Axis& y) {
    std::vector<Place> points;
    for (const ScatterPoint& p : chart.points) {
        points.push_back({plot_left + x.share(p.x) * (plot_right - plot_left),
                          plot_bottom + y.share(p.y) * (plot_top - plot_bottom)});
    }
    NamePlaces places(points);
    std::string out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Place at = places.put(points[i], chart.points[i].name.size());
        const bool is_left = at.x < points[i].x;
        const double end_x = is_left ? at.x + name_width(chart.points[i].name.size()) : at.x;
        out +=
            fmt::format("set label {} at screen {:.4f}, screen {:.4f} {}\n", in_quotes(chart.points[i].name),
                        end_x / size.width, at.y / size.height, is_left ? "right" : "left");
        if (std::hypot(end_x - points[i].x, at.y - points[i].y) < 20) continue;
        out += fmt::format(
            "set arrow from screen {:.4f}, screen {:.4f} to screen {:.4f}, screen {:.4f} nohead linewidth "
            "0.7 "
            "linecolor rgb '#808080'\n",
            points[i].x / size.width, points[i].y / size.height, (end_x + (is_left ? 3 : -3)) / size.width,
            at.y / size.height);
    }
    return out;
}

// From blue, the floor, to red: what is at the floor has none of what the scale shows.
std::string colour_scale(const ScatterChart& chart) {
    double most = chart.colour_floor * 10;
    for (const ScatterPoint& p : chart.points) most = std::max(most, p.colour);
    const int last = int(std::ceil(std::log10(most)));
    return fmt::format(
        "set palette defined (0 '#0072b2', 0.25 '#56b4e9', 0.5 '#f0c040', 0.75 '#e07010', 1 '#a00000')\n"
        "{}set cblabel {} offset 1.5,0\n"
        "set colorbox user origin screen 0.87, screen {:.4f} size screen 0.02, screen {:.4f}\n",
        decimal_axis_with_zero("cb", chart.colour_floor, chart.colour_floor, std::pow(10.0, last)),
        in_quotes(chart.colour_label), plot_bottom / size.height, (plot_top - plot_bottom) / size.height);
}

std::string plane(const ScatterChart& chart, const Axis& x, const Axis& y) {
    std::string out = fmt::format("set xlabel {}\nset ylabel {}\nunset key\n", in_quotes(chart.x_label),
                                  in_quotes(chart.y_label));
    for (const auto& [axis, range] : {std::pair("x", x), std::pair("y", y)}) {
        out += range.is_logarithmic ? decimal_axis(axis, range.lo, range.hi)
                                    : fmt::format("set {}range [{}:{}]\n", axis, range.lo, range.hi);
    }
    return out + fmt::format(
                     "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset bmargin at screen "
                     "{:.4f}\nset tmargin at screen {:.4f}\n",
                     plot_left / size.width, plot_right / size.width, plot_bottom / size.height,
                     plot_top / size.height);
}

}  // namespace

std::string gnuplot_script(const ScatterChart& chart, ChartFormat format) {
    std::string out = terminal(format, size, chart.name) + title(chart.title) + axes();
    if (chart.points.empty()) {
        return out + "set xrange [0:1]\nset yrange [0:1]\nplot NaN title 'no data'\n";
    }
    const Axis x = axis_of(chart.points, &ScatterPoint::x, chart.is_x_logarithmic);
    const Axis y = axis_of(chart.points, &ScatterPoint::y, chart.is_y_logarithmic);
    std::string data = "$points << END\n";
    for (const ScatterPoint& p : chart.points) {
        data += fmt::format("{} {} {}\n", p.x, p.y, std::max(p.colour, chart.colour_floor));
    }
    return out + plane(chart, x, y) + colour_scale(chart) + names(chart, x, y) + data +
           "END\nplot $points using 1:2:3 with points pointtype 7 pointsize 1.3 linecolor palette\n";
}

std::string draw(const ScatterChart& chart, ChartFormat format) {
    return run_gnuplot_script(gnuplot_script(chart, format), chart.name);
}

}  // namespace rtu::study
