#include "study/stability/stability_tally.hpp"

#include <algorithm>
#include <cmath>

namespace rtu::study {
namespace {

constexpr int least_exponent = -10, exponents = 64;
constexpr std::size_t bins_per_octave = 64;

std::size_t bin_of(double value) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);  // in [1/2, 1)
    if (value == 0 || exponent <= least_exponent) return 0;
    if (exponent > least_exponent + exponents) return exponents * bins_per_octave;
    const auto part = std::size_t((2 * fraction - 1) * double(bins_per_octave));
    return 1 + std::size_t(exponent - 1 - least_exponent) * bins_per_octave + part;
}

double upper_end(std::size_t bin) {
    const std::size_t octave = bin / bins_per_octave, part = bin % bins_per_octave;
    return std::ldexp(1 + double(part) / double(bins_per_octave), int(octave) + least_exponent);
}

double float_ulp(double value) {
    int exponent = 0;
    static_cast<void>(std::frexp(value, &exponent));
    return std::ldexp(1.0, std::max(exponent - 1, -126) - 23);
}

}  // namespace

void ErrorHistogram::add(double value) {
    const std::size_t bin = bin_of(value);
    if (bins_.size() <= bin) bins_.resize(bin + 1);
    ++bins_[bin];
    ++count_;
    max_ = std::max(max_, value);
}

ErrorHistogram& ErrorHistogram::operator+=(const ErrorHistogram& other) {
    if (bins_.size() < other.bins_.size()) bins_.resize(other.bins_.size());
    for (std::size_t i = 0; i < other.bins_.size(); ++i) bins_[i] += other.bins_[i];
    count_ += other.count_;
    max_ = std::max(max_, other.max_);
    return *this;
}

std::optional<double> ErrorHistogram::quantile(double share) const {
    if (count_ == 0) return std::nullopt;
    const auto wanted = std::uint64_t(std::ceil(share * double(count_)));
    std::uint64_t passed = 0;
    for (std::size_t bin = 0; bin + 1 < bins_.size(); ++bin) {
        passed += bins_[bin];
        if (passed >= wanted) return std::min(upper_end(bin), max_);
    }
    return max_;
}

Tally& Tally::operator+=(const Tally& other) {
    rays += other.rays;
    hits += other.hits;
    leaks += other.leaks;
    doubles += other.doubles;
    parity_errors += other.parity_errors;
    false_hits += other.false_hits;
    false_misses += other.false_misses;
    wrong_owners += other.wrong_owners;
    non_finite += other.non_finite;
    self_hits += other.self_hits;
    variant_errors += other.variant_errors;
    order_errors += other.order_errors;
    box_errors += other.box_errors;
    t_ulp += other.t_ulp;
    uv_ulp += other.uv_ulp;
    false_hit_margin = std::max(false_hit_margin, other.false_hit_margin);
    false_miss_margin = std::max(false_miss_margin, other.false_miss_margin);
    return *this;
}

void judge_numbers(const OracleDecision& exact, const model::methods::TestHit& hit, Tally& tally) {
    ++tally.hits;
    if (!std::isfinite(hit.t) || !std::isfinite(hit.u) || !std::isfinite(hit.v)) {
        ++tally.non_finite;
        return;
    }
    if (!exact.is_met()) return;
    tally.t_ulp.add(std::abs(double(hit.t) - exact.t) / float_ulp(exact.t));
    const double u = std::abs(double(hit.u) - exact.u), v = std::abs(double(hit.v) - exact.v);
    tally.uv_ulp.add(std::max(u, v) * 0x1p24);
}

void judge_triangle(const model::Ray& ray, const model::methods::Corners& corners,
                    const OracleDecision& exact, const std::optional<model::methods::TestHit>& answer,
                    Tally& tally) {
    if (answer) judge_numbers(exact, *answer, tally);
    if (answer && !exact.is_met()) {
        ++tally.false_hits;
        if (exact.meeting == Meeting::Miss && model::is_finite(ray.direction)) {
            const double margin = edge_margin_ulps(ray, corners, exact);
            if (std::isfinite(margin)) tally.false_hit_margin = std::max(tally.false_hit_margin, margin);
        }
    }
    if (!answer && exact.is_inside()) {
        ++tally.false_misses;
        tally.false_miss_margin = std::max(tally.false_miss_margin, edge_margin_ulps(ray, corners, exact));
    }
    const bool is_on_border = exact.is_met() && exact.meeting != Meeting::Interior;
    if (is_on_border && answer.has_value() != exact.is_hit()) ++tally.wrong_owners;
}

}  // namespace rtu::study
