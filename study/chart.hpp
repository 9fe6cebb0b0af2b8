#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rtu::study {

/// One line, or one bar of each group.
struct ChartSeries {
    std::string name;
    /// Lines: (x, y). Bars: x is the group's index.
    std::vector<std::pair<double, double>> points;
    std::optional<double> level;  ///< lines: a height that does not depend on x, drawn dashed over all of it
    std::vector<std::pair<double, double>> marks;  ///< bars: a value beside it, drawn as a diamond
    std::size_t colour = 0;                        ///< which of the palette; it repeats
};

/// A chart of lines or, when there are groups, of bars. Text may hold anything; control characters are shown
/// as blanks.
struct Chart {
    std::string name;  ///< of its files, without extension: letters, digits and underscores
    std::string title;
    std::string x_label;
    std::string y_label;
    bool is_x_logarithmic = false;  ///< to base 2
    bool has_zero_line = false;  ///< lines: the height 0 is shown, whatever the values; bars always show it
    std::vector<std::string> groups;
    std::vector<ChartSeries> series;
    std::string mark_name;  ///< what the diamonds are; empty for none
};

enum class ChartFormat : std::uint8_t { Svg, Png };

/// The chart as a gnuplot script with its data inline. Text stands in single quotes only, in which gnuplot
/// expands nothing. The ids within an SVG begin with the chart's name, so that several fit one page.
[[nodiscard]] std::string gnuplot_script(const Chart& chart, ChartFormat format);

/// Throws Error, naming the package, when gnuplot is not on the PATH.
void check_gnuplot();

/// The chart drawn by gnuplot, a child process without a shell, as the bytes of a file. The same bytes for
/// the same chart and gnuplot. Throws Error when gnuplot is missing or fails.
[[nodiscard]] std::string draw(const Chart& chart, ChartFormat format);

}  // namespace rtu::study
