#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "study/chart/any_chart.hpp"
#include "study/sweep/sqlite.hpp"
#include "study/sweep/sweep_chart.hpp"

namespace rtu::study {

/// One point of a chart: the geometric mean over scenes, and how far single ones lie from it. With one scene
/// and nothing to compare with, the ends are those of the figure's interval.
struct SweepFigure {
    std::string panel, series, x;
    double value = 0;
    double least = 0, most = 0;
    std::uint64_t samples = 0;  ///< that it is the mean of
};

/// The figures of a chart, from the most exact rows of each design. Where several designs stand at one place
/// the best of a scene counts, but against a base every one does. `Best` gives percent of the best, `Base`
/// percent more than the base. Throws Error when no row is left, or none has a base to compare with.
[[nodiscard]] std::vector<SweepFigure> sweep_figures(const SqlDatabase& database, const SweepChart& chart);

/// The picture: lines over numbers, bars beside names.
[[nodiscard]] AnyChart sweep_picture(const SweepChart& chart, std::span<const SweepFigure> figures);

/// The same as a table, for people.
[[nodiscard]] std::string sweep_figure_table(const SweepChart& chart, std::span<const SweepFigure> figures);

}  // namespace rtu::study
