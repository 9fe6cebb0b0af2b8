#pragma once

#include <string>
#include <variant>

#include "study/chart/chart.hpp"
#include "study/chart/heat_map.hpp"
#include "study/chart/pixel_panels.hpp"
#include "study/chart/scatter_chart.hpp"

namespace rtu::study {

/// A picture of any kind.
using AnyChart = std::variant<Chart, ChartPanels, ScatterChart, HeatMap, PixelPanels>;

[[nodiscard]] inline const std::string& name_of(const AnyChart& chart) {
    return std::visit([](const auto& c) -> const std::string& { return c.name; }, chart);
}
[[nodiscard]] inline const std::string& title_of(const AnyChart& chart) {
    return std::visit([](const auto& c) -> const std::string& { return c.title; }, chart);
}
[[nodiscard]] inline std::string draw(const AnyChart& chart, ChartFormat format) {
    return std::visit([&](const auto& c) { return draw(c, format); }, chart);
}

}  // namespace rtu::study
