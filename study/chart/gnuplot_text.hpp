#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study/chart/chart_format.hpp"

// The parts of a gnuplot script that all charts share.

namespace rtu::study::gnuplot {

/// Okabe and Ito's colours, apart for every kind of colour vision; black and yellow left out: both are lost
/// on one of the two backgrounds.
inline constexpr std::array<std::string_view, 6> colours{"#0072b2", "#d55e00", "#009e73",
                                                         "#cc79a7", "#56b4e9", "#e69f00"};

struct PixelSize {
    int width = 0, height = 0;
};

/// `text` in single quotes, within which gnuplot expands nothing. What would end them, control characters and
/// bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A block of data that `$name` stands for.
[[nodiscard]] std::string data_block(std::string_view name,
                                     const std::vector<std::pair<double, double>>& points);

/// The same with an interval of y at each point.
[[nodiscard]] std::string span_block(std::string_view name,
                                     const std::vector<std::pair<double, double>>& points,
                                     const std::vector<std::pair<double, double>>& spans);

/// The part of a plot command that draws such a block, without an entry in the legend.
[[nodiscard]] std::string span_plot(std::string_view name, std::string_view colour);

/// The first line of a script; ids within an SVG begin with `name`.
[[nodiscard]] std::string terminal(ChartFormat format, PixelSize size, std::string_view name);

/// The title at the top left. It is a label: gnuplot centres titles over the plot, and beside a wide legend a
/// long one would be cut.
[[nodiscard]] std::string title(std::string_view text);

/// Axes at the left and bottom, and thin lines behind the plot.
[[nodiscard]] std::string axes();

/// An axis ("x" or "y") is logarithmic to base 2.
[[nodiscard]] std::string binary_axis(std::string_view axis);

/// An axis ("x", "y" or "cb") is logarithmic to base 10 and goes from lo to hi (both positive), with a tic
/// every decade, or at 1, 2 and 5 of each when there are few.
[[nodiscard]] std::string decimal_axis(std::string_view axis, double lo, double hi);

/// The same, but the tic at `floor`, which stands for all below it, says 0.
[[nodiscard]] std::string decimal_axis_with_zero(std::string_view axis, double floor, double lo, double hi);

}  // namespace rtu::study::gnuplot
