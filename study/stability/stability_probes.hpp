#pragma once

#include "study/stability/stability_experiment.hpp"

// Rays and triangles at which methods fail, one family a function; all are a function of the random numbers
// only. Lengths are in scene units.

namespace rtu::study {

/// Uniform in [low, high).
[[nodiscard]] float draw_between(model::RandomStream& random, float low, float high);
/// Uniform in the cube [-size, size)^3.
[[nodiscard]] model::Vec3 draw_point(model::RandomStream& random, float size);
/// 0 to count - 1, count in [1, 2^24].
[[nodiscard]] std::uint32_t draw_below(model::RandomStream& random, std::uint32_t count);

/// From `origin` through `target`, without an end; along z where these coincide.
[[nodiscard]] model::Ray ray_through(model::Vec3 origin, model::Vec3 target);

/// What a probe's ray is aimed at.
enum class Target : std::uint8_t { Inside, Edge, Vertex, Around };

/// A point of the triangle, its border, or its surroundings.
[[nodiscard]] model::Vec3 draw_target(model::RandomStream& random, const model::methods::Corners& corners,
                                      Target target);

/// A triangle of about `size` around the origin of coordinates, seen from about `distance` away, everything
/// moved by `offset`.
[[nodiscard]] DrawProbe probe_of_size(float size, float distance, float offset, Target target);

/// A ray along -z that passes `ulps` units in the last place outside (or, half of the time, inside) of an
/// edge of a triangle whose coordinates are below 2.
[[nodiscard]] DrawProbe probe_beside_edge(float ulps);

/// A triangle of size 1, met at an angle in radians.
[[nodiscard]] DrawProbe probe_at_angle(float angle);

/// A triangle as high as `ratio` times its length.
[[nodiscard]] DrawProbe probe_of_sliver(float ratio, Target target);

/// Triangles without area, or without any as seen from the ray.
enum class Degeneracy : std::uint8_t { OnePoint, TwoPoints, Collinear, NearlyCollinear, EdgeOn };
[[nodiscard]] DrawProbe probe_of_degenerate(Degeneracy kind);

/// Coordinates of random signs and magnitudes 10^-decades to 10^decades, the ray aimed inside.
[[nodiscard]] DrawProbe probe_of_mixed_scales(float decades);

/// A direction of this length, components that vanish in binary32 included.
[[nodiscard]] DrawProbe probe_of_direction_length(double length);

/// Where an end of the ray's interval lies relative to an exact t.
enum class IntervalEnd : std::uint8_t { MinAtT, MinBelowT, MaxAtT, MaxAboveT, BothAtT, OriginOnSurface };
/// t is a power of two times an integer from 1 to 100, exactly; `exponent` of that power.
[[nodiscard]] DrawProbe probe_of_interval(IntervalEnd end, int exponent);

/// Which number is not one.
enum class Spoilt : std::uint8_t {
    OriginNan,
    DirectionNan,
    MinNan,
    MaxNan,
    VertexNanX,
    VertexNanYz,
    OriginInfinite,
    DirectionInfinite,
    VertexInfinite
};
[[nodiscard]] DrawProbe probe_of_spoilt(Spoilt kind);

/// Triangles around one edge, `leaves` of them at random angles; the ray at a point of the edge.
[[nodiscard]] DrawFan fan_at_edge(std::uint32_t leaves);
/// Both triangles on the same side of the plane through their edge, one behind the other.
[[nodiscard]] DrawFan folded_pair();
/// A long edge with a vertex of two other triangles on it: exactly, or rounded to the nearest binary32.
[[nodiscard]] DrawFan t_junction(bool is_exact);

}  // namespace rtu::study
