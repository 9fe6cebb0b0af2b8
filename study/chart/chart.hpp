#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/chart/chart_format.hpp"

namespace rtu::study {

/// One line, or one bar of each group.
struct ChartSeries {
    std::string name;
    /// Lines: (x, y). Bars: x is the group's index.
    std::vector<std::pair<double, double>> points;
    std::optional<double> level;  ///< lines: a height that does not depend on x, drawn dashed over all of it
    std::vector<std::pair<double, double>> marks;  ///< bars: a value beside it, drawn as a diamond
    /// Which of the six of the palette; beyond it they repeat, lines with other dashes and points.
    std::size_t colour = 0;
    /// [points.size()] or empty: the least and the greatest y of each point, drawn as a thin bar.
    std::vector<std::pair<double, double>> spans = {};
    bool has_line = true;  ///< lines: from point to point; false for places that do not follow each other
};

/// A chart of lines or, when there are groups, of bars. Text may hold anything; control characters are shown
/// as blanks.
struct Chart {
    std::string name;  ///< of its files, without extension: letters, digits and underscores
    std::string title;
    std::string x_label;
    std::string y_label;
    bool is_x_logarithmic = false;  ///< to base x_base
    bool has_zero_line = false;  ///< lines: the height 0 is shown, whatever the values; bars always show it
    std::vector<std::string> groups;
    std::vector<ChartSeries> series;
    std::string mark_name;  ///< what the diamonds are; empty for none
    int x_base = 2;         ///< of a logarithmic x, 2 or 10
    /// Lines: y is logarithmic to base 10, and a value that is not above this height, 0 among them, is drawn
    /// at it; its tic says 0.
    std::optional<double> y_floor = std::nullopt;
    bool has_points = true;  ///< lines: a mark at every point
    bool has_lines = true;   ///< lines: from point to point; without them has_points must be true
};

/// Line charts side by side with the same series in the same order; one legend serves all.
struct ChartPanels {
    std::string name;
    std::string title;
    std::vector<Chart> panels;  ///< each with a title of its own
};

/// The chart as a gnuplot script with its data inline. Text stands in single quotes only, in which gnuplot
/// expands nothing. The ids within an SVG begin with the chart's name, so that several fit one page.
[[nodiscard]] std::string gnuplot_script(const Chart& chart, ChartFormat format);

[[nodiscard]] std::string gnuplot_script(const ChartPanels& panels, ChartFormat format);

/// The chart drawn by gnuplot, as run_gnuplot_script() does.
[[nodiscard]] std::string draw(const Chart& chart, ChartFormat format);
[[nodiscard]] std::string draw(const ChartPanels& panels, ChartFormat format);

}  // namespace rtu::study
