#include "study/chart/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/one_line.hpp"
#include "study/chart/gnuplot_text.hpp"

namespace rtu::study {
namespace {

using namespace gnuplot;

constexpr int cell_width = 58, cell_height = 26, scale_width = 140, character_width = 9;

int longest(const std::vector<std::string>& names) {
    std::size_t characters = 0;
    for (const std::string& name : names) characters = std::max(characters, name.size());
    return int(characters) * character_width;
}

struct Layout {
    PixelSize size;
    double left, right, bottom, top;  // of the grid, shares of the picture
};

Layout layout_of(const HeatMap& map) {
    const int left = longest(map.rows) + 25, head = 85 + int(0.68 * longest(map.columns));
    const int grid_width = cell_width * int(map.columns.size());
    const int grid_height = cell_height * int(map.rows.size());
    // The last column's name leans over the grid's right end.
    const int width = std::max(left + grid_width + scale_width, 760);
    const int height = head + grid_height + 30;
    return {{width, height},
            double(left) / width,
            double(left + grid_width) / width,
            30.0 / height,
            double(30 + grid_height) / height};
}

std::string tics(const HeatMap& map) {
    std::string columns, rows;
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
        columns += fmt::format("{}{} {}", i == 0 ? "" : ", ", in_quotes(map.columns[i]), i);
    }
    for (std::size_t i = 0; i < map.rows.size(); ++i) {
        rows += fmt::format("{}{} {}", i == 0 ? "" : ", ", in_quotes(map.rows[i]), i);
    }
    return fmt::format(
        "unset xtics\nset x2tics ({}) rotate by 45 left scale 0 textcolor rgb 'black'\n"
        "set ytics ({}) scale 0 textcolor rgb 'black'\nset xrange [-0.5:{}]\nset x2range [-0.5:{}]\n"
        "set yrange [{}:-0.5]\n",
        columns, rows, double(map.columns.size()) - 0.5, double(map.columns.size()) - 0.5,
        double(map.rows.size()) - 0.5);
}

// White is none; then from yellow to dark red.
std::string colour_scale(const HeatMap& map, double most, const Layout& layout) {
    const int last = std::max(int(std::ceil(std::log10(most))), int(std::floor(std::log10(map.floor))) + 1);
    return fmt::format(
        "set palette defined (0 '#fff3b0', 0.4 '#f5a742', 0.75 '#d1391f', 1 '#6e0b14')\n{}"
        "set cblabel {} offset 1.5,0\n"
        "set colorbox user origin screen {:.4f}, screen {:.4f} size screen {:.4f}, screen {:.4f}\n",
        decimal_axis("cb", map.floor, std::pow(10.0, last)), in_quotes(map.colour_label),
        layout.right + 18.0 / layout.size.width, layout.bottom, 14.0 / layout.size.width,
        layout.top - layout.bottom);
}

struct Cells {
    std::string coloured, none;  // x, y, value; x, y
    std::string dark, light;     // x, y, text: by the colour of the text
    double most = 0;
};

// What ends a text of a data block, or begins an escape in one.
std::string without_quotes(std::string_view text) {
    std::string out = model::printable(text);
    std::ranges::replace_if(
        out, [](char c) { return c == '"' || c == '\\'; }, '?');
    return out;
}

Cells cells_of(const HeatMap& map) {
    Cells out;
    for (const auto& row : map.cells) {
        for (const auto& cell : row) {
            if (cell) out.most = std::max(out.most, cell->value);
        }
    }
    out.most = std::max(out.most, map.floor * 10);
    for (std::size_t y = 0; y < map.cells.size(); ++y) {
        for (std::size_t x = 0; x < map.cells[y].size(); ++x) {
            const auto& cell = map.cells[y][x];
            if (!cell) continue;
            const bool is_none = cell->value < map.floor;
            (is_none ? out.none : out.coloured) += fmt::format("{} {} {}\n", x, y, cell->value);
            const bool is_on_dark =
                !is_none && std::log(cell->value / map.floor) / std::log(out.most / map.floor) > 0.6;
            // A blank would begin a further column.
            (is_on_dark ? out.light : out.dark) +=
                fmt::format("{} {} \"{}\"\n", x, y, without_quotes(cell->text));
        }
    }
    return out;
}

std::string boxes(std::string_view block, std::string_view colour) {
    return fmt::format(
        "${} using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5){} with boxxyerror fillstyle solid "
        "1.0 noborder {}",
        block, colour == "palette" ? ":3" : "",
        colour == "palette" ? "linecolor palette" : fmt::format("linecolor rgb '{}'", colour));
}

}  // namespace

std::string gnuplot_script(const HeatMap& map, ChartFormat format) {
    const Layout layout = layout_of(map);
    std::string out = terminal(format, layout.size, map.name) + title(map.title) +
                      "set border 0\nunset key\nunset colorbox\nset tics nomirror\n";
    const Cells cells = cells_of(map);
    if (cells.coloured.empty() && cells.none.empty()) {
        return out + "set xrange [0:1]\nset yrange [0:1]\nset key\nplot NaN title 'no data'\n";
    }
    out += fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset bmargin at screen "
        "{:.4f}\nset tmargin at screen {:.4f}\n",
        layout.left, layout.right, layout.bottom, layout.top);
    out += tics(map) + colour_scale(map, cells.most, layout);
    std::string plots;
    const auto add = [&](std::string_view block, const std::string& data, const std::string& plot) {
        if (data.empty()) return;
        out += fmt::format("${} << END\n{}END\n", block, data);
        plots += (plots.empty() ? "" : ", ") + plot;
    };
    add("coloured", cells.coloured, boxes("coloured", "palette"));
    add("none", cells.none, boxes("none", "#e8f1e4"));
    // Not quite black and white: within a page those become the page's own.
    add("dark", cells.dark, "$dark using 1:2:3 with labels textcolor rgb '#101010'");
    add("light", cells.light, "$light using 1:2:3 with labels textcolor rgb '#f8f8f8'");
    return out + "plot " + plots + "\n";
}

std::string draw(const HeatMap& map, ChartFormat format) {
    return run_gnuplot_script(gnuplot_script(map, format), map.name);
}

}  // namespace rtu::study
