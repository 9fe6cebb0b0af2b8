#include "study/chart/pixel_panels.hpp"

#include <fmt/format.h>

#include "study/chart/gnuplot_text.hpp"

namespace rtu::study {
namespace {

using namespace gnuplot;

constexpr int margin = 20, head = 60, panel_head = 30, foot = 40, panel_size = 400;

std::string palette(const PixelPanels& panels) {
    std::string colours_of_classes;
    for (std::size_t i = 0; i < panels.classes.size(); ++i) {
        colours_of_classes += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, panels.classes[i].colour);
    }
    return fmt::format("set palette maxcolors {} defined ({})\nset cbrange [-0.5:{}]\nunset colorbox\n",
                       panels.classes.size(), colours_of_classes, double(panels.classes.size()) - 0.5);
}

std::string pixel_rows(const PixelPanels& panels, const PixelPanels::Panel& panel) {
    std::string out;
    for (std::uint32_t y = 0; y < panels.height; ++y) {
        for (std::uint32_t x = 0; x < panels.width; ++x) {
            out += char('0' + panel.pixels[std::size_t(y) * panels.width + x]);
            out += x + 1 < panels.width ? ' ' : '\n';
        }
    }
    return out;
}

// Squares in the classes' colours with their names, along the bottom.
std::string legend(const PixelPanels& panels, PixelSize size) {
    std::string out;
    double x = margin + 10;
    for (std::size_t i = 0; i < panels.classes.size(); ++i) {
        out += fmt::format(
            "set object {} rectangle from screen {:.4f}, screen {:.4f} to screen {:.4f}, screen {:.4f} "
            "fillcolor rgb '{}' fillstyle solid 1.0 border linecolor rgb '#808080'\n"
            "set label {} {} at screen {:.4f}, screen {:.4f} left\n",
            i + 1, x / size.width, 12.0 / size.height, (x + 16) / size.width, 28.0 / size.height,
            panels.classes[i].colour, i + 2, in_quotes(panels.classes[i].name), (x + 22) / size.width,
            20.0 / size.height);
        x += 50 + 7.5 * double(panels.classes[i].name.size());
    }
    return out;
}

}  // namespace

std::string gnuplot_script(const PixelPanels& panels, ChartFormat format) {
    const int rows = (int(panels.panels.size()) + 1) / 2;
    const PixelSize size{2 * panel_size + 3 * margin, head + rows * (panel_size + panel_head) + foot};
    std::string out = terminal(format, size, panels.name) + title(panels.title) + palette(panels) +
                      legend(panels, size) +
                      "set border 15 linecolor rgb '#808080'\nunset key\nunset tics\nset multiplot\n";
    for (std::size_t i = 0; i < panels.panels.size(); ++i) {
        const double left = margin + double(i % 2) * (panel_size + margin);
        const double top = size.height - head - double(i / 2) * (panel_size + panel_head) - panel_head;
        out += fmt::format("$panel{} << END\n{}END\n", i, pixel_rows(panels, panels.panels[i]));
        out += fmt::format(
            "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
            "set bmargin at screen {:.4f}\nset title {} offset 0,-0.5\nset xrange [-0.5:{}]\nset yrange "
            "[{}:-0.5]\nplot $panel{} matrix with image{}\n",
            left / size.width, (left + panel_size) / size.width, top / size.height,
            (top - panel_size) / size.height, in_quotes(panels.panels[i].title), panels.width - 0.5,
            panels.height - 0.5, i, "");
        if (i == 0) out += "unset label\nunset object\n";  // once is enough
    }
    return out + "unset multiplot\n";
}

std::string draw(const PixelPanels& panels, ChartFormat format) {
    return run_gnuplot_script(gnuplot_script(panels, format), panels.name);
}

}  // namespace rtu::study
