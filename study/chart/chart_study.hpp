#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/chart/any_chart.hpp"
#include "study/methods/method_charts.hpp"
#include "study/run_options.hpp"

namespace rtu::study {

/// A picture that `rtusim chart` can make.
struct ChartInfo {
    std::string_view name;     ///< as on the command line
    std::string_view meaning;  ///< what it shows, one line
    std::string_view reading;  ///< how to read it, for people
};

/// All of them, in the order of the page.
[[nodiscard]] std::span<const ChartInfo> known_charts();

struct ChartOptions {
    std::vector<std::string> names;  ///< of known_charts(); empty: all
    std::uint32_t rays = 500;        ///< a setting, of all studies
    std::uint32_t repeats = 3;       ///< of the timings
    SceneSource scene;               ///< for the precision ladder
    std::optional<std::filesystem::path> camera_file;
    std::uint64_t seed = 1;
    std::function<void(std::string_view phase)> progress;  ///< told now and then; may be empty
};

/// What the chosen charts are made of; parts that none of them needs are left out.
struct ChartData {
    std::optional<MethodsReport> leaf_speeds, packet_speeds;
    std::optional<StabilityReport> stability;
    std::optional<PrecisionReport> precision;
    std::vector<OffsetRow> offsets;
    std::vector<ParityMap> parity;
    std::uint32_t parity_size = 0;  ///< width and height of its pictures
};

/// Throws Error, listing the known ones, for a name that is not there or given twice.
void check_chart_names(const std::vector<std::string>& names);

/// Runs the studies that the charts need.
[[nodiscard]] ChartData measure_charts(const ChartOptions& options);

struct NamedChart {
    const ChartInfo* info;
    AnyChart chart;
};

/// The chosen charts.
[[nodiscard]] std::vector<NamedChart> make_charts(const ChartOptions& options, const ChartData& data);

/// One self-contained page: every chart, drawn by gnuplot, and how to read it.
[[nodiscard]] std::string charts_html(const ChartOptions& options, std::span<const NamedChart> charts);

}  // namespace rtu::study
