#pragma once

#include <string>
#include <string_view>

#include "study/chart/chart.hpp"

namespace rtu::study {

/// The greatest y of a chart's points.
[[nodiscard]] double largest_y(const Chart& chart);

/// The part of a script that draws a chart's lines: data, axes' scales and ranges, and the plot command.
/// Names of data blocks begin with `prefix`. A logarithmic y axis reaches to `y_most`.
[[nodiscard]] std::string line_plot(const Chart& chart, std::string_view prefix, double y_most);

/// A plot command that draws nothing but the entries of the legend.
[[nodiscard]] std::string legend_plot(const Chart& chart);

}  // namespace rtu::study
