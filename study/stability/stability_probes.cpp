#include "study/stability/stability_probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/sampling.hpp"
#include "model/vec3.hpp"

namespace rtu::study {

using model::RandomStream;
using model::Ray;
using model::Vec3;
using model::methods::Corners;

namespace {

using model::infinity;

Vec3 mix(const Corners& t, float u, float v) { return t[0] * (1 - u - v) + t[1] * u + t[2] * v; }

Vec3 inside(RandomStream& random, const Corners& triangle) {
    const float a = random.next(), b = random.next();
    return a + b < 1 ? mix(triangle, a, b) : mix(triangle, 1 - a, 1 - b);
}

Corners any_triangle(RandomStream& random, float size) {
    const Vec3 a = draw_point(random, size), b = draw_point(random, size);
    return {a, b, draw_point(random, size)};
}

bool draw_coin(RandomStream& random) { return random.next() < 0.5F; }

// Base ten by repeated squaring: library powers differ between machines.
double power_of_ten(double exponent) {
    const double whole = std::floor(exponent);
    double result = 1 + (exponent - whole) * 9;  // between the powers a straight line will do
    for (int i = 0; i < int(std::abs(whole)); ++i) result = whole < 0 ? result / 10 : result * 10;
    return result;
}

Corners seen_from_above(RandomStream& random, float z) {
    return {Vec3{draw_between(random, -2, -1), draw_between(random, -2, -1), z},
            Vec3{draw_between(random, 1, 2), draw_between(random, -2, -1), z},
            Vec3{draw_between(random, -1, 1), draw_between(random, 1, 2), z}};
}

}  // namespace

float draw_between(RandomStream& random, float low, float high) { return low + (high - low) * random.next(); }

Vec3 draw_point(RandomStream& random, float size) {
    const float x = draw_between(random, -size, size), y = draw_between(random, -size, size);
    return {x, y, draw_between(random, -size, size)};
}

std::uint32_t draw_below(RandomStream& random, std::uint32_t count) {
    return std::uint32_t(random.next() * float(count)) % count;
}

Ray ray_through(Vec3 origin, Vec3 target) {
    const Vec3 direction = target - origin;
    return {origin, 0, direction == Vec3{} ? Vec3{0, 0, 1} : direction, infinity};
}

Vec3 draw_target(RandomStream& random, const Corners& corners, Target target) {
    if (target == Target::Inside) return inside(random, corners);
    const std::uint32_t corner = draw_below(random, 3);
    const Vec3 a = corners[corner], b = corners[(corner + 1) % 3];
    if (target == Target::Vertex) return a;
    if (target == Target::Edge) return a + (b - a) * random.next();
    return mix(corners, draw_between(random, -1, 2), draw_between(random, -1, 2));
}

DrawProbe probe_of_size(float size, float distance, float offset, Target target) {
    return [=](RandomStream& random) {
        Corners triangle = any_triangle(random, size);
        const Vec3 far{offset, -offset, 0.5F * offset};
        for (Vec3& corner : triangle) corner = corner + far;
        const Vec3 aim = draw_target(random, triangle, target);
        return Probe{ray_through(far + model::sample_sphere(random) * distance, aim), triangle};
    };
}

DrawProbe probe_beside_edge(float ulps) {
    return [=](RandomStream& random) {
        const Corners triangle = seen_from_above(random, draw_between(random, -1, 1));
        const std::uint32_t edge = draw_below(random, 3);
        const Vec3 a = triangle[edge], b = triangle[(edge + 1) % 3];
        const float s = random.next();
        const double dx = double(b.x) - a.x, dy = double(b.y) - a.y;
        const double outwards =
            (draw_coin(random) ? 1 : -1) * double(ulps) * 0x1p-23 / std::sqrt(dx * dx + dy * dy);
        const Vec3 origin{float(double(a.x) + dx * double(s) + dy * outwards),
                          float(double(a.y) + dy * double(s) - dx * outwards), 4};
        return Probe{{origin, 0, {0, 0, -1}, infinity}, triangle};
    };
}

DrawProbe probe_at_angle(float angle) {
    return [=](RandomStream& random) {
        while (true) {
            const Corners triangle = any_triangle(random, 1);
            const auto normal =
                model::direction_of(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
            const auto along = model::direction_between(triangle[0], inside(random, triangle));
            if (!normal || !along) continue;
            const Vec3 direction = *along + *normal * angle;  // sine and tangent are as good
            return Probe{{inside(random, triangle) - direction * 3.0F, 0, direction, infinity}, triangle};
        }
    };
}

DrawProbe probe_of_sliver(float ratio, Target target) {
    return [=](RandomStream& random) {
        Corners triangle = any_triangle(random, 1);
        triangle[2] = triangle[0] + (triangle[1] - triangle[0]) * random.next() + draw_point(random, ratio);
        const Vec3 aim = draw_target(random, triangle, target);
        return Probe{ray_through(draw_point(random, 3), aim), triangle};
    };
}

DrawProbe probe_of_degenerate(Degeneracy kind) {
    return [=](RandomStream& random) {
        // Coarse enough for five steps to be exact, and fine enough for a test's own arithmetic to round.
        const auto grid = [&] { return float(draw_below(random, 65536)) - 32768; };
        const Vec3 a{grid(), grid(), grid()};
        Vec3 step{grid(), grid(), grid()};
        if (step == Vec3{}) step = {1, 0, 0};
        Corners triangle{a, a + step * 2.0F, a + step * (1 + 4 * random.next())};
        if (kind == Degeneracy::OnePoint) triangle = {a, a, a};
        if (kind == Degeneracy::TwoPoints) triangle = {a, a + step, draw_coin(random) ? a : a + step};
        if (kind == Degeneracy::Collinear) triangle[2] = a + step * float(draw_below(random, 5));
        if (kind == Degeneracy::EdgeOn) {
            // Origin and direction in the plane z = a.z, exactly.
            triangle[1].z = triangle[2].z = a.z;
            triangle[2].x += 1;
            const Vec3 origin{grid() * 4, grid() * 4, a.z};
            const Vec3 target = draw_target(random, triangle, Target::Inside);
            return Probe{ray_through(origin, {target.x, target.y, a.z}), triangle};
        }
        const Vec3 target = draw_target(random, triangle, draw_coin(random) ? Target::Edge : Target::Vertex);
        return Probe{ray_through({grid() * 4, grid() * 4, grid() * 4}, target), triangle};
    };
}

DrawProbe probe_of_mixed_scales(float decades) {
    return [=](RandomStream& random) {
        const auto number = [&] {
            const double size = power_of_ten(double(draw_between(random, -decades, decades)));
            return float(draw_coin(random) ? size : -size);
        };
        const auto vector = [&] {
            const float x = number(), y = number();
            return Vec3{x, y, number()};
        };
        const Vec3 a = vector(), b = vector();
        const Corners triangle{a, b, vector()};
        const Vec3 target = inside(random, triangle);
        return Probe{ray_through(vector(), target), triangle};
    };
}

DrawProbe probe_of_direction_length(double length) {
    return [=](RandomStream& random) {
        Probe probe = probe_of_size(1, 3, 0, Target::Around)(random);
        const Vec3 unit = model::direction_of(probe.ray.direction).value_or(Vec3{0, 0, 1});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            probe.ray.direction[axis] = float(double(unit[axis]) * length);
        }
        return probe;
    };
}

DrawProbe probe_of_interval(IntervalEnd end, int exponent) {
    return [=](RandomStream& random) {
        if (end == IntervalEnd::OriginOnSurface) {
            const Corners triangle = any_triangle(random, 1);
            const Vec3 origin = inside(random, triangle);
            return Probe{{origin, 0, draw_point(random, 1), infinity}, triangle};
        }
        const auto steps = float(1 + draw_below(random, 100));
        const Corners triangle = seen_from_above(random, -steps);
        const Vec3 target = draw_target(random, triangle, Target::Inside);
        const float t = std::ldexp(steps, exponent);
        Probe probe{{{target.x, target.y, 0}, 0, {0, 0, -std::ldexp(1.0F, -exponent)}, infinity}, triangle};
        if (end == IntervalEnd::MinAtT || end == IntervalEnd::BothAtT) probe.ray.t_min = t;
        if (end == IntervalEnd::MinBelowT) probe.ray.t_min = std::nextafter(t, 0.0F);
        if (end == IntervalEnd::MaxAtT || end == IntervalEnd::BothAtT) probe.ray.t_max = t;
        if (end == IntervalEnd::MaxAboveT) probe.ray.t_max = std::nextafter(t, infinity);
        return probe;
    };
}

DrawProbe probe_of_spoilt(Spoilt kind) {
    return [=](RandomStream& random) {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        Probe probe = probe_of_size(1, 3, 0, Target::Inside)(random);
        const std::uint32_t axis = draw_below(random, 3), corner = draw_below(random, 3);
        const float infinite = draw_coin(random) ? infinity : -infinity;
        Ray& ray = probe.ray;
        if (kind == Spoilt::OriginNan) ray.origin[axis] = nan;
        if (kind == Spoilt::DirectionNan) ray.direction[axis] = nan;
        if (kind == Spoilt::MinNan) ray.t_min = nan;
        if (kind == Spoilt::MaxNan) ray.t_max = nan;
        if (kind == Spoilt::VertexNanX) probe.corners[corner].x = nan;
        if (kind == Spoilt::VertexNanYz) probe.corners[corner][1 + axis % 2] = nan;
        if (kind == Spoilt::OriginInfinite) ray.origin[axis] = infinite;
        if (kind == Spoilt::DirectionInfinite) ray.direction[axis] = infinite;
        if (kind == Spoilt::VertexInfinite) probe.corners[corner][axis] = infinite;
        return probe;
    };
}

DrawFan fan_at_edge(std::uint32_t leaves) {
    return [=](RandomStream& random) {
        const Vec3 a = draw_point(random, 1), b = draw_point(random, 1);
        Fan fan;
        for (std::uint32_t i = 0; i < leaves; ++i) {
            const Vec3 tip = draw_point(random, 1);
            fan.triangles.push_back(i % 2 == 0 ? Corners{a, b, tip} : Corners{b, a, tip});
        }
        fan.ray = ray_through(draw_point(random, 3), a + (b - a) * draw_between(random, 0.125F, 0.875F));
        return fan;
    };
}

DrawFan folded_pair() {
    return [](RandomStream& random) {
        const Corners front = seen_from_above(random, 0);
        const Vec3 tip{front[2].x, front[2].y, draw_between(random, -1, 0)};
        const Vec3 aim = draw_target(random, front, draw_coin(random) ? Target::Edge : Target::Inside);
        return Fan{ray_through({aim.x, aim.y, 4}, aim), {front, {front[1], front[0], tip}}};
    };
}

DrawFan t_junction(bool is_exact) {
    return [=](RandomStream& random) {
        const auto number = [&] {
            // Halves of sums of these are floats, exactly; where they need not be, another float is as good.
            const float coarse = float(draw_below(random, 2048)) * 0x1p-10F - 1;
            return is_exact ? coarse : coarse * (1 + random.next());
        };
        const auto vector = [&] {
            const float x = number(), y = number();
            return Vec3{x, y, number()};
        };
        const Vec3 a = vector(), b = vector(), tip = vector(), other = vector();
        const float share = is_exact ? 0.5F : random.next();
        const Vec3 middle = is_exact ? (a + b) * 0.5F : a + (b - a) * share;
        const Vec3 aim = draw_coin(random) ? middle : a + (b - a) * random.next();
        return Fan{ray_through(draw_point(random, 3), aim),
                   {{a, b, tip}, {b, middle, other}, {middle, a, other}}};
    };
}

}  // namespace rtu::study
