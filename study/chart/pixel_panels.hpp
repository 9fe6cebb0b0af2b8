#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/chart/chart_format.hpp"

namespace rtu::study {

/// Pictures side by side, each pixel of one of a few classes; two a row.
struct PixelPanels {
    struct Class {
        std::string name;
        std::string colour;  ///< "#rrggbb"
    };
    struct Panel {
        std::string title;
        std::vector<std::uint8_t> pixels;  ///< [height * width] index of the pixel's class, from the top left
    };
    std::string name;  ///< of its files: letters, digits and underscores
    std::string title;
    std::uint32_t width = 0, height = 0;  ///< of each panel, in pixels
    std::vector<Class> classes;
    std::vector<Panel> panels;
};

[[nodiscard]] std::string gnuplot_script(const PixelPanels& panels, ChartFormat format);
[[nodiscard]] std::string draw(const PixelPanels& panels, ChartFormat format);

}  // namespace rtu::study
