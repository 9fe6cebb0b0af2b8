#include "study/precision/precision_report.hpp"

#include <cmath>

namespace rtu::study {
namespace {

// That a Poisson variable of this mean is at most `events`.
double at_most(std::uint64_t events, double mean) {
    double term = std::exp(-mean), sum = term;
    for (std::uint64_t i = 1; i <= events; ++i) {
        term *= mean / double(i);
        sum += term;
    }
    return sum;
}

}  // namespace

double FilterRow::false_positive_percent() const {
    const std::uint64_t misses = tests - hits;
    return misses == 0 ? 0 : 100.0 * double(passed - (hits - false_negatives)) / double(misses);
}

double upper_rate_per_million(std::uint64_t events, std::uint64_t count) {
    if (count == 0) return 1e6;
    // Beyond some hundreds the normal approximation is good to a per mille, and exp() underflows.
    double lo = double(events), hi = double(events) + 5 + 3 * std::sqrt(double(events) + 1);
    if (events > 400) return 1e6 / double(count) * std::min(lo + 1.645 * std::sqrt(lo) + 1, double(count));
    for (int i = 0; i < 60; ++i) {
        const double middle = (lo + hi) / 2;
        (at_most(events, middle) > 0.05 ? lo : hi) = middle;
    }
    return 1e6 / double(count) * std::min(hi, double(count));
}

std::vector<const PrecisionRow*> ladder(const PrecisionReport& report, std::string_view scene,
                                        std::string_view method, std::uint32_t exponent_bits) {
    std::vector<const PrecisionRow*> rungs;
    for (const PrecisionRow& row : report.rows) {
        if (row.scene == scene && row.method == method && row.format.exponent_bits == exponent_bits) {
            rungs.push_back(&row);
        }
    }
    return rungs;
}

const PrecisionRow* narrowest_enough(const std::vector<const PrecisionRow*>& ladder) {
    const PrecisionRow* found = nullptr;
    for (auto row = ladder.rbegin(); row != ladder.rend() && (*row)->is_enough; ++row) found = *row;
    return found;
}

}  // namespace rtu::study
