#include "study/report/result_diff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"

namespace rtu::study {
namespace {

void compare_inputs(const ResultSet& before, const ResultSet& after, ResultDiff& diff) {
    for (const auto& [name, value] : before.inputs) {
        const auto other = after.inputs.find(name);
        const std::string text = other == after.inputs.end() ? "nothing" : other->second;
        if (text != value) diff.inputs.push_back(fmt::format("{}: {} -> {}", name, value, text));
    }
    for (const auto& [name, value] : after.inputs) {
        if (!before.inputs.contains(name))
            diff.inputs.push_back(fmt::format("{}: nothing -> {}", name, value));
    }
}

struct Trend {
    ResultTrend trend;
    double log_sum = 0;
    std::uint64_t log_count = 0;
};

void add(Trend& sums, const ResultChange& change, double tolerance_percent) {
    ResultTrend& trend = sums.trend;
    ++trend.compared;
    if (change.before > 0 && change.after > 0) {
        sums.log_sum += std::log(change.after / change.before);
        ++sums.log_count;
    }
    if (change.before == change.after) return;
    ++(change.after > change.before ? trend.up : trend.down);
    if (std::abs(change.percent()) > tolerance_percent) ++trend.significant;
    if (std::abs(change.percent()) > std::abs(trend.largest.percent())) trend.largest = change;
}

ResultTrend finished(Trend sums) {
    ResultTrend& trend = sums.trend;
    if (sums.log_count > 0) trend.mean_percent = 100 * std::expm1(sums.log_sum / double(sums.log_count));
    trend.p_value = sign_test(trend.up, trend.down);
    return std::move(trend);
}

}  // namespace

double ResultChange::percent() const {
    if (before == after) return 0;
    if (before == 0) return std::numeric_limits<double>::infinity();
    return 100 * (after / before - 1);
}

double sign_test(std::uint64_t up, std::uint64_t down) {
    const double n = double(up + down);
    double tail = 0;
    for (std::uint64_t k = 0; k <= std::min(up, down); ++k) {
        tail += std::exp(std::lgamma(n + 1) - std::lgamma(double(k) + 1) - std::lgamma(n - double(k) + 1) -
                         n * std::log(2.0));
    }
    return std::min(1.0, 2 * tail);
}

ResultDiff compare(const ResultSet& before, const ResultSet& after, double tolerance_percent) {
    if (before.is_sweep != after.is_sweep) throw Error("expected two runs or two sweeps, got one of each");
    ResultDiff diff;
    compare_inputs(before, after, diff);
    std::map<std::string, Trend> trends;
    for (const auto& [row, numbers] : before.rows) {
        const auto other = after.rows.find(row);
        if (other == after.rows.end()) {
            diff.only_before.push_back(row);
            continue;
        }
        for (const auto& [name, value] : numbers) {
            const auto found = other->second.find(name);
            if (found == other->second.end()) continue;
            const ResultChange change{row, name, value, found->second};
            ++diff.compared;
            add(trends[name], change, tolerance_percent);
            if (change.before == change.after) continue;
            diff.changes.push_back(change);
            if (std::abs(change.percent()) > tolerance_percent) ++diff.significant;
        }
    }
    for (const auto& [row, numbers] : after.rows) {
        if (!before.rows.contains(row)) diff.only_after.push_back(row);
    }
    for (auto& [name, trend] : trends) {
        if (trend.trend.up + trend.trend.down == 0) continue;
        trend.trend.name = name;
        diff.trends.push_back(finished(std::move(trend)));
    }
    return diff;
}

}  // namespace rtu::study
