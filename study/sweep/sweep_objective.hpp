#pragma once

#include <string>
#include <string_view>

namespace rtu::study {

/// What a sweep looks for: a column of the view `results`, and which way is better.
struct SweepObjective {
    std::string column;  ///< a measure (docs/sweeps.md), or a configuration key
    bool is_maximised = true;

    /// As in sweep files: "mrps", or "min l1.size_bytes".
    [[nodiscard]] std::string name() const;
    /// True when it is a ratio of counters that only a simulation of every ray has.
    [[nodiscard]] bool needs_counters() const;
    /// True when an estimate of it has an interval: columns `..._low` and `..._high` of `results`.
    [[nodiscard]] bool has_interval() const;
    /// True when `a` is better than `b`.
    [[nodiscard]] bool is_better(double a, double b) const { return is_maximised ? a > b : a < b; }
};

/// Reads one of the measures, or "min KEY" or "max KEY" of a key that holds a number. Throws Error, with
/// the known ones, for anything else; `place` begins its text.
[[nodiscard]] SweepObjective parse_sweep_objective(std::string_view text, const std::string& place);

}  // namespace rtu::study
