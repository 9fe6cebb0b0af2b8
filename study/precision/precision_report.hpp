#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/methods/number_format.hpp"

namespace rtu::study {

/// What a method in one number format does with a scene's rays. The exact answer is that of the machine's own
/// test on the numbers as they were given; ray and triangle are rounded to the format before a method sees
/// them. The method `exact` decides and measures without rounding on those rounded numbers: it shows what
/// storing them costs, whatever the arithmetic.
struct PrecisionRow {
    std::string scene;
    std::string method;
    model::methods::NumberFormat format;
    std::uint64_t tests = 0;         ///< ray-triangle tests of the sampled rays' traversals
    std::uint64_t false_hits = 0;    ///< tests hit that are exactly missed
    std::uint64_t false_misses = 0;  ///< tests missed that are exactly hit
    std::uint64_t rays = 0;
    std::uint64_t lost = 0;        ///< rays that hit something, but not here
    std::uint64_t gained = 0;      ///< rays that hit nothing, but do here
    std::uint64_t moved = 0;       ///< rays whose nearest hit is off by more than the tolerance
    std::uint64_t aimed_rays = 0;  ///< rays at edges and vertices that hit the surface around, if exact
    std::uint64_t leaks = 0;       ///< of those, through all triangles around
    std::uint64_t doubles = 0;     ///< of those, with more hits than exact
    /// Error of t where test and exact test hit, in units in the last place of the exact t in binary32; no
    /// values without hits.
    std::optional<double> t_ulp_p50, t_ulp_p99, t_ulp_max;
    std::optional<double> area;       ///< area_proxy() of a test; none for `exact`
    std::uint32_t triangle_bits = 0;  ///< as the method stores it, in this format
    bool is_enough = false;

    [[nodiscard]] std::uint64_t wrong() const { return lost + gained + moved; }
    [[nodiscard]] bool is_watertight() const { return leaks == 0 && doubles == 0; }
};

/// A quantised filter on the tests of a scene's rays.
struct FilterRow {
    std::string scene;
    model::methods::NumberFormat format;
    std::uint64_t tests = 0;
    std::uint64_t hits = 0;             ///< exactly hit
    std::uint64_t passed = 0;           ///< passed on to an exact test
    std::uint64_t false_negatives = 0;  ///< exactly hit, not passed on: 0
    double area = 0;                    ///< area_proxy() of the filter

    /// Share of the misses that are passed on, in percent.
    [[nodiscard]] double false_positive_percent() const;
};

/// What a scene needs.
struct PrecisionAnswer {
    std::string scene;
    std::uint64_t rays = 0;
    std::vector<std::string> workloads;
    /// In PrecisionReport::rows: of least area among those good enough, and among those of them that neither
    /// leak nor hit twice.
    std::optional<std::size_t> row, watertight_row;
};

struct PrecisionReport {
    std::string version;
    std::uint64_t seed = 0;
    double t_tolerance = 0;        ///< of the exact t
    double wrong_per_million = 0;  ///< what is tolerated
    std::vector<PrecisionAnswer> scenes;
    std::vector<PrecisionRow> rows;  ///< by scene, method, format
    std::vector<FilterRow> filters;  ///< by scene, format
};

/// The rate per million that is exceeded with a probability of at most 5 % when `events` were seen in `count`
/// trials (Poisson): 3 / count for none.
[[nodiscard]] double upper_rate_per_million(std::uint64_t events, std::uint64_t count);

/// The rows of a scene and method whose exponents have that many bits, from narrow to wide.
[[nodiscard]] std::vector<const PrecisionRow*> ladder(const PrecisionReport& report, std::string_view scene,
                                                      std::string_view method, std::uint32_t exponent_bits);

/// The narrowest row of a ladder from which on every wider one is good enough, too; null when there is none.
[[nodiscard]] const PrecisionRow* narrowest_enough(const std::vector<const PrecisionRow*>& ladder);

}  // namespace rtu::study
