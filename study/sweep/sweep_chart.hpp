#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// Charts that a sweep file asks for; described in docs/sweeps.md.

namespace rtu::study {

/// Columns of `answers` and the values that they must have.
using SweepFilter = std::vector<std::pair<std::string, std::string>>;

/// One chart of what a sweep gave. Columns are configuration keys, preset, pairing, scene and workload.
struct SweepChart {
    /// What a value is shown against: nothing, the best of its scene and workload, or the same design with
    /// other values of some columns (`base`).
    enum class Against : std::uint8_t { Nothing, Best, Base };

    std::string name;  ///< of its files
    std::string title;
    std::string x;
    bool is_x_logarithmic = false;
    std::string y = "mrps";           ///< a measure of the view
    std::vector<std::string> series;  ///< columns; empty: one line
    std::string panels;               ///< a column; empty: one panel
    std::string workload = "total";   ///< when that is not a column of the chart
    SweepFilter where;                ///< other rows are left out
    Against against = Against::Nothing;
    SweepFilter base;

    /// x, series and panels.
    [[nodiscard]] std::vector<std::string> columns() const;
    [[nodiscard]] bool has_column(const std::string& column) const;
};

}  // namespace rtu::study
