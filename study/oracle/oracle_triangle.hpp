#pragma once

#include <array>
#include <optional>

#include "study/oracle/oracle_meeting.hpp"

namespace rtu::study {

/// Which arithmetic was needed.
enum class OracleTier : std::uint8_t { Binary64, Integers, Rationals };

/// What the exact answer is for one ray and one triangle.
struct OracleDecision {
    Meeting meeting = Meeting::Miss;  ///< of the ray's line
    std::uint8_t feature = 0;         ///< edge or vertex of an Edge or Vertex meeting
    bool is_owner = false;            ///< the triangle owns the line: ExactMeeting::is_owner()
    bool is_in_interval = false;      ///< t is inside the open interval; false unless the line meets
    OracleTier tier = OracleTier::Binary64;
    /// Of Interior, Edge and Vertex meetings; good to 2^-40: t of itself, u and v of 1.
    double t = 0, u = 0, v = 0;
    /// ExactMeeting::weight(), good to 2^-12 of itself, with the exact sign. Only when the meeting is not a
    /// Miss or exact arithmetic was needed; else as binary64 has it, of which those that decide have their
    /// signs.
    std::array<double, 3> weights{};

    /// The line meets the triangle or its border, within the interval.
    [[nodiscard]] bool is_met() const { return is_in_interval; }
    /// The one triangle of a closed surface that must be hit here.
    [[nodiscard]] bool is_hit() const { return is_owner && is_in_interval; }
    /// Met inside: every method should find it.
    [[nodiscard]] bool is_inside() const { return meeting == Meeting::Interior && is_in_interval; }
};

/// Decides without rounding: binary64 where its forward error bound proves the signs, 256-bit integers where
/// the numbers' exponents lie close enough, else rationals. Equal to meet_exactly() always. For rays that
/// can_hit() and finite corners; everything else is a Miss, after the rules of docs/stability.md.
[[nodiscard]] OracleDecision decide(const model::Ray& ray, const model::methods::Corners& corners);

/// The sign of direction . ((b - a) x (c - a)): from which side the line comes; 0 for a triangle seen edge-on
/// or without area. Exact, for finite numbers.
[[nodiscard]] int facing(const model::Ray& ray, const model::methods::Corners& corners);

/// True when binary64 alone proves that the ray's line passes outside the triangle.
[[nodiscard]] bool is_surely_missed(const model::Ray& ray, const model::methods::Corners& corners);

/// The same decision by 256-bit integers; nothing when the exponents are too far apart.
[[nodiscard]] std::optional<OracleDecision> decide_by_integers(const model::Ray& ray,
                                                               const model::methods::Corners& corners);

/// The same decision by rationals.
[[nodiscard]] OracleDecision decide_by_rationals(const model::Ray& ray,
                                                 const model::methods::Corners& corners);

/// How far the line passes from the triangle's nearest edge, seen along the ray, in units in the last place
/// (binary32) of the corners' largest sheared coordinate: what a test in binary32 has to resolve. 0 on an
/// edge, and where a corner's coordinates make no triangle.
[[nodiscard]] double edge_margin_ulps(const model::Ray& ray, const model::methods::Corners& corners,
                                      const OracleDecision& decision);

}  // namespace rtu::study
