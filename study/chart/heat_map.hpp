#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/chart/chart_format.hpp"

namespace rtu::study {

/// A grid of cells, each coloured by its value on a logarithmic scale, with a short text in it.
struct HeatMap {
    struct Cell {
        double value = 0;
        std::string text;
    };
    std::string name;  ///< of its files: letters, digits and underscores
    std::string title;
    std::string colour_label;
    std::vector<std::string> columns, rows;               ///< rows from the top
    std::vector<std::vector<std::optional<Cell>>> cells;  ///< [rows][columns]; an empty one is left blank
    double floor = 1;  ///< positive; values below it have the colour of none
};

[[nodiscard]] std::string gnuplot_script(const HeatMap& map, ChartFormat format);
[[nodiscard]] std::string draw(const HeatMap& map, ChartFormat format);

}  // namespace rtu::study
