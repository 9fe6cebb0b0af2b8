#pragma once

#include <boost/multiprecision/gmp.hpp>

#include "study/oracle/oracle_meeting.hpp"

namespace rtu::study {

/// A rational without rounding or limits. Not with expression templates: these keep references to
/// temporaries.
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

/// What a ray and a triangle have in common, in rational arithmetic on the numbers as they were given. t, u,
/// v are those of Interior, Edge and Vertex meetings, and 0 otherwise.
struct RationalMeeting {
    Meeting meeting = Meeting::Miss;
    std::uint8_t feature = 0;         ///< the edge or vertex: ExactMeeting::feature()
    bool is_owner = false;            ///< ExactMeeting::is_owner()
    Rational t, u, v;                 ///< the point is origin + t direction, and (1 - u - v) a + u b + v c
    std::array<Rational, 3> weights;  ///< ExactMeeting::weight()
};

/// The reference that every faster oracle is held against. All numbers must be finite, the direction not
/// zero; the ray's interval plays no part.
[[nodiscard]] RationalMeeting meet_exactly(const model::Ray& ray, const model::methods::Corners& corners);

/// Whether t lies in the ray's open interval. t_min and t_max may be infinite, not NaN. A t that no finite
/// binary32 is near never does.
[[nodiscard]] bool is_in_interval(const model::Ray& ray, const Rational& t);

/// The nearest binary32, of two equally near ones the even one; infinity beyond the largest.
[[nodiscard]] float rounded_to_float(const Rational& value);

}  // namespace rtu::study
