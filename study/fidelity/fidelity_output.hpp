#pragma once

#include <span>
#include <string>

#include "study/chart/chart.hpp"
#include "study/fidelity/fidelity_study.hpp"

namespace rtu::study {

/// Each level over all its rows: how far off, how often inside its interval, how much faster.
[[nodiscard]] std::string fidelity_summary(const FidelityReport& report);

/// The summary, every comparison in a line, and the rankings.
[[nodiscard]] std::string fidelity_text(const FidelityReport& report);
[[nodiscard]] std::string fidelity_json(const FidelityReport& report);
[[nodiscard]] std::string fidelity_csv(const FidelityReport& report);

/// Host speed against MRPS error: a point for every scene and level, medians over machines and workloads.
[[nodiscard]] Chart fidelity_chart(const FidelityReport& report);

/// Rows of single estimates, without anything to compare them with, as `rtusim run --fidelity` prints them.
[[nodiscard]] std::string estimates_text(std::span<const FidelityRow> rows);
[[nodiscard]] std::string estimates_json(std::span<const FidelityRow> rows);
[[nodiscard]] std::string rows_csv(std::span<const FidelityRow> rows);

}  // namespace rtu::study
