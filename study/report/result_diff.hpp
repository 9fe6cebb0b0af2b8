#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// What changed between two results: reports of `rtusim run --json`, or databases of sweeps.

namespace rtu::study {

/// All numbers of a result. A row is a workload of a scene, and of a design in a sweep.
struct ResultSet {
    bool is_sweep = false;
    std::map<std::string, std::string> inputs;                  ///< what it was made from
    std::map<std::string, std::map<std::string, double>> rows;  ///< [row][name of the number]
};

/// Reads either kind, without host times. Throws Error for a file that is neither.
[[nodiscard]] ResultSet load_result(const std::filesystem::path& path);

/// A number that both have, with different values.
struct ResultChange {
    std::string row;
    std::string name;
    double before = 0, after = 0;

    /// after / before - 1 in percent; infinite when only `before` is 0.
    [[nodiscard]] double percent() const;
};

/// One name over all rows.
struct ResultTrend {
    std::string name;
    std::uint64_t compared = 0;
    std::uint64_t up = 0, down = 0;
    std::uint64_t significant = 0;  ///< rows that changed by more than the tolerance
    double mean_percent = 0;        ///< by the geometric mean of after / before, over rows where neither is 0
    /// Of the two-sided sign test: how often equal chances of up and down would give a split as uneven.
    double p_value = 1;
    ResultChange largest;
};

/// Nothing that is simulated is random, so that every change is real; it is called significant when it is by
/// more than the tolerance.
struct ResultDiff {
    std::vector<std::string> inputs;                   ///< lines, one for each input that differs
    std::vector<std::string> only_before, only_after;  ///< rows
    std::vector<ResultChange> changes;                 ///< in the order of rows and names
    std::vector<ResultTrend> trends;                   ///< of names that changed somewhere
    std::uint64_t compared = 0;                        ///< numbers
    std::uint64_t significant = 0;                     ///< changes

    /// True when a row is missing or a change is significant.
    [[nodiscard]] bool is_significant() const {
        return significant > 0 || !only_before.empty() || !only_after.empty();
    }
};

/// Throws Error when one is a run and the other a sweep.
[[nodiscard]] ResultDiff compare(const ResultSet& before, const ResultSet& after, double tolerance_percent);

/// For people: a row a change for two runs, a row a name for two sweeps.
[[nodiscard]] std::string diff_text(const ResultDiff& diff, bool is_sweep, double tolerance_percent);

/// Two-sided sign test: the probability that `up + down` fair coins fall at least as unevenly.
[[nodiscard]] double sign_test(std::uint64_t up, std::uint64_t down);

}  // namespace rtu::study
