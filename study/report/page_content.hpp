#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

// What stands on the report page, without how it looks: sections of findings and charts. A chart is a table
// and which of its columns are drawn, so that the table beside a chart always has the numbers of the chart.

namespace rtu::study {

/// A cell: not there, a number, or a name.
using PageCell = std::variant<std::monostate, double, std::string>;

/// A column of a chart's table; numbers are shown with that many decimals.
struct PageColumn {
    std::string name;
    int decimals = 0;
};

struct PageChart {
    enum class Kind : std::uint8_t {
        Bars,    ///< beside one another, a cluster for each value of `x`
        Stack,   ///< likewise, on top of one another
        Lines,   ///< y over a number x, in the order of the rows
        Points,  ///< y over a number x
        Matrix,  ///< a coloured cell for each value of `x` and of `group`
    };
    Kind kind = Kind::Bars;
    std::string title;
    std::string note;  ///< how to read it
    std::vector<PageColumn> columns;
    std::vector<std::vector<PageCell>> rows;  ///< [rows][columns]
    std::size_t x = 0;                        ///< column of categories, or of the numbers x
    std::vector<std::size_t> values;          ///< columns drawn, a series each; one when there is a group
    std::optional<std::size_t> group;         ///< column of names: a series (of a matrix, a row) for each
    std::string y_title;
    bool is_x_log = false;
    bool is_y_log = false;  ///< of a matrix: the scale of colours
};

/// What a result says, in plain language.
struct PageFinding {
    std::string subject;  ///< what it is about: "bunny: primary, shadow"
    std::string text;     ///< what was found
    std::string advice;   ///< what to change; may be empty
    std::string figures;  ///< the numbers that it rests on
};

/// Numbers of a picture, at most 65,536 cells, row by row from the top left.
struct PageHeatMap {
    std::string title;
    std::uint32_t columns = 0, rows = 0;
    std::uint32_t pixels = 1;             ///< a cell stands for a square with this side
    std::vector<double> mean;             ///< [rows * columns]
    std::vector<std::uint32_t> greatest;  ///< [rows * columns], of the cell's pixels
};

/// A column of the points of a sweep; either numbers or names is filled.
struct PageField {
    std::string name;
    std::string better;  ///< "more", "less" or empty: whether more of it is better
    bool is_parameter = false;
    std::vector<std::optional<double>> numbers;  ///< [points]
    std::vector<std::string> names;              ///< [points]
};

/// Points to be filtered and drawn against one another.
struct PageExplorer {
    std::vector<PageField> fields;
    std::string x, y, color;  ///< fields to begin with
};

struct PageSection {
    std::string id;  ///< letters, digits and hyphens
    std::string title;
    std::string note;
    std::vector<PageFinding> findings;
    std::vector<PageChart> charts;
    std::vector<PageHeatMap> heat_maps;
    std::optional<PageExplorer> explorer;
};

/// As the page's script reads it. Numbers have six significant digits; NaN and infinities are null.
[[nodiscard]] nlohmann::ordered_json page_json(const PageSection& section);

}  // namespace rtu::study
