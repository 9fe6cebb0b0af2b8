#include <fmt/format.h>

#include <algorithm>

#include "study/chart/chart.hpp"
#include "study/chart/chart_lines.hpp"
#include "study/chart/gnuplot_text.hpp"

namespace rtu::study {
namespace {

using namespace gnuplot;

constexpr int panel_width = 400, key_width = 330, left_width = 95, gap = 80;

PixelSize size_of(const ChartPanels& panels) {
    const int count = int(panels.panels.size());
    const int rows = panels.panels.empty() ? 0 : int(panels.panels.front().series.size());
    return {left_width + count * panel_width + (count - 1) * gap + key_width, std::max(460, 110 + rows * 20)};
}

// A panel's place in the picture as shares of its width; the legend stands once, at the right.
std::string place(std::size_t index, int width) {
    const double left = left_width + double(index) * (panel_width + gap);
    return fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen 0.84\n"
        "set bmargin at screen 0.13\n",
        left / width, (left + panel_width) / width);
}

// A plot of its own that shows nothing else, as high as the picture.
std::string legend(const Chart& panel, PixelSize size) {
    return fmt::format(
               "set lmargin at screen {:.4f}\nset rmargin at screen 0.99\nset tmargin at screen 0.9\n"
               "set bmargin at screen 0.02\nunset title\nunset border\nunset tics\nunset xlabel\nunset "
               "ylabel\nunset logscale\nset xrange [0:1]\nset yrange [0:1]\nset key inside left top vertical "
               "Left reverse samplen 3\n",
               1 - double(key_width - 10) / size.width) +
           legend_plot(panel);
}

}  // namespace

std::string gnuplot_script(const ChartPanels& panels, ChartFormat format) {
    if (panels.panels.empty()) {
        Chart nothing;
        nothing.name = panels.name;
        nothing.title = panels.title;
        return gnuplot_script(nothing, format);
    }
    const PixelSize size = size_of(panels);
    std::string out =
        terminal(format, size, panels.name) + title(panels.title) + axes() + "unset key\nset multiplot\n";
    double most = 0;  // the panels have one scale
    for (const Chart& panel : panels.panels) most = std::max(most, largest_y(panel));
    for (std::size_t i = 0; i < panels.panels.size(); ++i) {
        const Chart& panel = panels.panels[i];
        out += place(i, size.width);
        out += fmt::format("set title {}\nset xlabel {}\nset ylabel {}\n", in_quotes(panel.title),
                           in_quotes(panel.x_label), in_quotes(i == 0 ? panel.y_label : ""));
        out += line_plot(panel, fmt::format("panel{}_", i), most);
        out += "unset label 1\n";  // else every panel would write the title once more
    }
    return out + legend(panels.panels.front(), size) + "unset multiplot\n";
}

std::string draw(const ChartPanels& panels, ChartFormat format) {
    return run_gnuplot_script(gnuplot_script(panels, format), panels.name);
}

}  // namespace rtu::study
