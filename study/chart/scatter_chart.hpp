#pragma once

#include <string>
#include <vector>

#include "study/chart/chart_format.hpp"

namespace rtu::study {

/// A point with a name beside it and a colour from the chart's scale.
struct ScatterPoint {
    std::string name;
    double x = 0, y = 0;
    double colour = 0;
};

/// Points over two axes, with a colour scale as the third quantity. Names of points near each other are set
/// apart and joined to their points by thin lines.
struct ScatterChart {
    std::string name;  ///< of its files: letters, digits and underscores
    std::string title;
    std::string x_label, y_label, colour_label;
    bool is_x_logarithmic = false, is_y_logarithmic = false;  ///< to base 10; all values positive then
    /// The colour scale is logarithmic; values below this are drawn as it, and its tic says 0.
    double colour_floor = 1;
    std::vector<ScatterPoint> points;
};

[[nodiscard]] std::string gnuplot_script(const ScatterChart& chart, ChartFormat format);
[[nodiscard]] std::string draw(const ScatterChart& chart, ChartFormat format);

}  // namespace rtu::study
