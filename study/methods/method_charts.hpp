#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/methods/operation_counts.hpp"
#include "study/chart/any_chart.hpp"
#include "study/methods/methods_report.hpp"
#include "study/precision/precision_report.hpp"
#include "study/stability/stability_run.hpp"

// The studies of ray-triangle methods as pictures, each made from rows that a study has measured.

namespace rtu::study {

/// A method on a closed ball that is far from the world's origin.
struct OffsetRow {
    std::string method;  ///< MethodInfo::name
    double offset = 0;
    std::string aim;  ///< "edge" or "vertex"
    std::uint64_t rays = 0, leaks = 0, doubles = 0;
};

/// How often rays from inside hit a closed mesh, for one method: pixels of a picture that is looked at from
/// inside.
struct ParityMap {
    std::string method;
    std::vector<std::uint32_t> hits;  ///< [height * width] of the ray whose number is furthest from 1
};

/// Speed of 1 ray x 8 triangles over the p99 error of t, coloured by leaks at edges and vertices.
[[nodiscard]] ScatterChart speed_chart(const MethodsReport& speeds, const StabilityReport& stability);

/// Leaks and double hits against the offset, for edges and vertices.
[[nodiscard]] ChartPanels offset_chart(std::span<const OffsetRow> rows);

/// Failures per million rays of every method in every case.
[[nodiscard]] HeatMap failure_chart(const StabilityReport& stability);

/// Share of the hits whose error of t is no larger than so many units, near the origin and far from it.
[[nodiscard]] ChartPanels error_chart(const StabilityReport& stability);

/// Multiplications and additions of one triangle, two, and a pair, of the methods that have a pair form.
[[nodiscard]] Chart operation_chart(std::span<const model::methods::MethodCounts> counts);

/// The methods of width_chart(): those with published speeds, and others to compare.
inline constexpr std::array<std::string_view, 6> width_chart_methods{
    "wald", "shevtsov", "havel_herout", "moller_trumbore", "woop", "woop_top_left"};

/// Speed of packets against their width, with the published ones.
[[nodiscard]] Chart width_chart(const MethodsReport& speeds);

/// How many hits rays from inside have, for each method.
[[nodiscard]] PixelPanels parity_chart(std::span<const ParityMap> maps, std::uint32_t width,
                                       std::uint32_t height);

/// Wrong rays against the area of the arithmetic, a line a method, a point a format. Of the report's first
/// scene.
[[nodiscard]] Chart precision_chart(const PrecisionReport& precision);

}  // namespace rtu::study
