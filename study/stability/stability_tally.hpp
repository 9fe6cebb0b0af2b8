#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "study/oracle/oracle_triangle.hpp"

namespace rtu::study {

/// How often errors of which size occurred, in bins of 1/64 octave; sums of histograms do not depend on the
/// order in which they are taken.
class ErrorHistogram {
  public:
    /// A value >= 0, not NaN; below 2^-10 all are alike, above 2^54 only the maximum tells them apart.
    void add(double value);
    ErrorHistogram& operator+=(const ErrorHistogram& other);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double max() const { return max_; }
    /// What at least this share of the values, in (0, 1], does not exceed, at most 1.6 % too high and never
    /// above max(); nothing without values.
    [[nodiscard]] std::optional<double> quantile(double share) const;

  private:
    std::vector<std::uint64_t> bins_;  // as many as the largest value has needed
    std::uint64_t count_ = 0;
    double max_ = 0;
};

/// What one method did with the rays of one setting. Definitions: docs/stability.md.
struct Tally {
    std::uint64_t rays = 0;           ///< rays, or rays with a triangle
    std::uint64_t hits = 0;           ///< hits reported
    std::uint64_t leaks = 0;          ///< rays with fewer hits than the surface has crossings, but for those
                                      ///< that miss a way in and the way out beside it
    std::uint64_t doubles = 0;        ///< rays with more, but for those likewise
    std::uint64_t parity_errors = 0;  ///< rays whose hits are odd in number and crossings even, or vice versa
    std::uint64_t false_hits = 0;     ///< hits of a triangle that the ray does not meet, border included
    std::uint64_t false_misses = 0;   ///< triangles met inside and not hit
    std::uint64_t wrong_owners = 0;   ///< rays with neither, and yet other triangles than exact arithmetic's
    std::uint64_t non_finite = 0;     ///< hits with a NaN or infinity in t, u or v
    std::uint64_t self_hits = 0;      ///< rays that hit the surface which they leave
    std::uint64_t variant_errors = 0;  ///< rays whose answer changes with what must not change it
    std::uint64_t order_errors = 0;    ///< pairs of hits whose distances come in the wrong order
    std::uint64_t box_errors = 0;      ///< hits whose box the slab test culls
    ErrorHistogram t_ulp;              ///< error of t in units in the last place of the exact t
    ErrorHistogram uv_ulp;             ///< larger error of u and v in units of 2^-24
    double false_hit_margin = 0;       ///< largest edge_margin_ulps() of a false hit, and of a false miss
    double false_miss_margin = 0;

    Tally& operator+=(const Tally& other);
};

/// Adds a hit's errors, and whether it is finite.
void judge_numbers(const OracleDecision& exact, const model::methods::TestHit& hit, Tally& tally);

/// Adds what an answer for one triangle is worth, its errors included; not `rays`.
void judge_triangle(const model::Ray& ray, const model::methods::Corners& corners,
                    const OracleDecision& exact, const std::optional<model::methods::TestHit>& answer,
                    Tally& tally);

}  // namespace rtu::study
