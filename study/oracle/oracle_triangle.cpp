#include "study/oracle/oracle_triangle.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "model/ray_setup.hpp"
#include "study/oracle/oracle_rational.hpp"

namespace rtu::study {
namespace {

using model::Ray;
using model::methods::Corners;
using Double3 = NumberVector<double>;
// Wide enough for sums of six products of three 81-bit numbers.
using Integer = boost::multiprecision::int256_t;
constexpr int integer_bits = 80;

Double3 difference(model::Vec3 to, model::Vec3 from) {
    return {double(to.x) - double(from.x), double(to.y) - double(from.y), double(to.z) - double(from.z)};
}

Double3 cross(const Double3& a, const Double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double largest(const Double3& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

double sum_of_sizes(const Double3& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }

// x . (y x z) of once-rounded differences: seven roundings of 2^-53 on the way of a term, and terms that add
// up to 2 |x|_1 |y|_max |z|_max at most.
constexpr double triple_error = 0x1p-48;

// A value and how far it may be from the truth.
struct Bounded {
    double value = 0, error = 0;
    [[nodiscard]] bool has_sign() const { return std::abs(value) > error; }
    // Good to 2^-42 of itself.
    [[nodiscard]] bool is_precise() const { return std::abs(value) > 0x1p42 * error; }
};

Bounded triple(const Double3& x, const Double3& y, const Double3& z) {
    return {dot(x, cross(y, z)), triple_error * sum_of_sizes(x) * (largest(y) * largest(z))};
}

std::array<Bounded, 3> weights_of(const Ray& ray, const Corners& corners) {
    const Double3 d = difference(ray.direction, {});
    std::array<Bounded, 3> weights;
    for (std::size_t i = 0; i < 3; ++i) {
        const model::Vec3 p = corners[(i + 1) % 3], q = corners[(i + 2) % 3];
        weights[i] = triple(d, difference(p, ray.origin), difference(q, p));
    }
    return weights;
}

bool have_opposite_signs(const std::array<Bounded, 3>& weights) {
    const auto is_positive = [](const Bounded& w) { return w.has_sign() && w.value > 0; };
    const auto is_negative = [](const Bounded& w) { return w.has_sign() && w.value < 0; };
    return std::any_of(weights.begin(), weights.end(), is_positive) &&
           std::any_of(weights.begin(), weights.end(), is_negative);
}

// Nothing when t is too near an end of the interval for binary64 to tell, or may be.
std::optional<bool> is_inside_interval(const Ray& ray, double t) {
    const auto is_near = [t](double limit) {
        return limit != 0 && std::abs(t - limit) <= 0x1p-38 * std::abs(t);
    };
    const double t_max = std::min(double(ray.t_max), first_to_round_to_infinity);
    if (is_near(ray.t_min) || is_near(t_max)) return std::nullopt;
    return t > double(ray.t_min) && t < t_max;
}

bool is_meeting(Meeting meeting) {
    return meeting == Meeting::Interior || meeting == Meeting::Edge || meeting == Meeting::Vertex;
}

std::optional<OracleDecision> decide_inside(const Ray& ray, const Corners& corners,
                                            const std::array<Bounded, 3>& weights) {
    const Double3 ab = difference(corners[1], corners[0]), ac = difference(corners[2], corners[0]);
    const Bounded along = triple(difference(ray.direction, {}), ab, ac);
    const Bounded before = triple(difference(corners[0], ray.origin), ab, ac);
    if (!along.is_precise() || !before.is_precise()) return std::nullopt;
    OracleDecision decision{Meeting::Interior, 0, true};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(weights[i].error < 0x1p-42 * std::abs(along.value))) return std::nullopt;
        if (!(std::abs(weights[i].value) > 0x1p12 * weights[i].error)) return std::nullopt;
        decision.weights[i] = weights[i].value;
    }
    decision.t = before.value / along.value;
    decision.u = weights[1].value / along.value;
    decision.v = weights[2].value / along.value;
    const auto is_inside = is_inside_interval(ray, decision.t);
    if (!is_inside) return std::nullopt;
    decision.is_in_interval = *is_inside;
    return decision;
}

// The place of a float's last set bit, and one above its first; for a zero, nothing that matters.
struct BitRange {
    int low = 1 << 20, high = -(1 << 20);
    void extend(float value) {
        if (value == 0) return;
        int exponent = 0;
        const float fraction = std::frexp(value, &exponent);
        auto digits = std::uint32_t(std::ldexp(std::abs(fraction), 24));
        high = std::max(high, exponent);
        int place = exponent - 24;
        for (; (digits & 1U) == 0; digits >>= 1U) ++place;
        low = std::min(low, place);
    }
    void extend(model::Vec3 v) {
        for (std::size_t axis = 0; axis < 3; ++axis) extend(v[axis]);
    }
    [[nodiscard]] bool fits() const { return high - low <= integer_bits; }
};

NumberVector<Integer> scaled(model::Vec3 v, int low) {
    NumberVector<Integer> result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (v[axis] == 0) continue;
        int exponent = 0;
        const float fraction = std::frexp(v[axis], &exponent);
        const auto digits = std::int64_t(std::ldexp(fraction, 24));
        const int shift = exponent - 24 - low;
        const Integer size(digits < 0 ? -digits : digits);
        const Integer moved =
            shift >= 0 ? Integer(size << unsigned(shift)) : Integer(size >> unsigned(-shift));
        result[axis] = digits < 0 ? Integer(-moved) : moved;
    }
    return result;
}

OracleDecision miss() { return {}; }

}  // namespace

bool is_surely_missed(const Ray& ray, const Corners& corners) {
    return have_opposite_signs(weights_of(ray, corners));
}

int facing(const Ray& ray, const Corners& corners) {
    const Bounded along = triple(difference(ray.direction, {}), difference(corners[1], corners[0]),
                                 difference(corners[2], corners[0]));
    if (along.has_sign()) return along.value > 0 ? 1 : -1;
    const RationalMeeting exact = meet_exactly(ray, corners);
    const Rational sum = exact.weights[0] + exact.weights[1] + exact.weights[2];
    return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

std::optional<OracleDecision> decide_by_integers(const Ray& ray, const Corners& corners) {
    BitRange positions, directions;
    positions.extend(ray.origin);
    for (const model::Vec3 corner : corners) positions.extend(corner);
    directions.extend(ray.direction);
    if (!positions.fits() || !directions.fits()) return std::nullopt;
    const auto place = [&positions](model::Vec3 v) { return scaled(v, positions.low); };
    const ExactMeeting<Integer> exact(place(ray.origin), scaled(ray.direction, directions.low),
                                      {place(corners[0]), place(corners[1]), place(corners[2])},
                                      largest_axis(ray.direction));
    OracleDecision decision{exact.meeting(), exact.feature(), exact.is_owner()};
    decision.tier = OracleTier::Integers;
    const int scale = 2 * positions.low + directions.low;
    for (std::size_t i = 0; i < 3; ++i) {
        decision.weights[i] = std::ldexp(exact.weight(i).convert_to<double>(), scale);
    }
    if (!is_meeting(decision.meeting)) return decision;
    const double along = exact.along().convert_to<double>();
    decision.t = std::ldexp(exact.before().convert_to<double>() / along, positions.low - directions.low);
    decision.u = exact.weight(1).convert_to<double>() / along;
    decision.v = exact.weight(2).convert_to<double>() / along;
    const auto is_inside = is_inside_interval(ray, decision.t);
    if (!is_inside) return std::nullopt;
    decision.is_in_interval = *is_inside;
    return decision;
}

OracleDecision decide_by_rationals(const Ray& ray, const Corners& corners) {
    const RationalMeeting exact = meet_exactly(ray, corners);
    OracleDecision decision{exact.meeting, exact.feature, exact.is_owner};
    decision.tier = OracleTier::Rationals;
    decision.is_in_interval = is_meeting(exact.meeting) && is_in_interval(ray, exact.t);
    decision.t = exact.t.convert_to<double>();
    decision.u = exact.u.convert_to<double>();
    decision.v = exact.v.convert_to<double>();
    for (std::size_t i = 0; i < 3; ++i) decision.weights[i] = exact.weights[i].convert_to<double>();
    return decision;
}

OracleDecision decide(const Ray& ray, const Corners& corners) {
    if (!model::can_hit(ray) || !std::all_of(corners.begin(), corners.end(), model::is_finite)) return miss();
    const std::array<Bounded, 3> weights = weights_of(ray, corners);
    if (have_opposite_signs(weights)) {
        OracleDecision decision = miss();
        for (std::size_t i = 0; i < 3; ++i) decision.weights[i] = weights[i].value;
        return decision;
    }
    if (std::all_of(weights.begin(), weights.end(), [](const Bounded& w) { return w.has_sign(); })) {
        if (const auto decision = decide_inside(ray, corners, weights)) return *decision;
    }
    if (const auto decision = decide_by_integers(ray, corners)) return *decision;
    return decide_by_rationals(ray, corners);
}

double edge_margin_ulps(const Ray& ray, const Corners& corners, const OracleDecision& decision) {
    const std::size_t z = largest_axis(ray.direction), x = (z + 1) % 3, y = (z + 2) % 3;
    const double dz = ray.direction[z];
    const double slope_x = double(ray.direction[x]) / dz, slope_y = double(ray.direction[y]) / dz;
    struct Point {
        double x, y;
    };
    std::array<Point, 3> seen{};
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Double3 a = difference(corners[i], ray.origin);
        seen[i] = {a[x] - slope_x * a[z], a[y] - slope_y * a[z]};
        reach = std::max({reach, std::abs(seen[i].x), std::abs(seen[i].y)});
    }
    if (reach == 0) return 0;
    double least = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point &p = seen[(i + 1) % 3], &q = seen[(i + 2) % 3];
        const double ex = q.x - p.x, ey = q.y - p.y, length = ex * ex + ey * ey;
        const double place = length > 0 ? -(p.x * ex + p.y * ey) / length : 0;
        const double distance = place <= 0   ? std::hypot(p.x, p.y)
                                : place >= 1 ? std::hypot(q.x, q.y)
                                             : std::abs(decision.weights[i] / dz) / std::sqrt(length);
        least = std::min(least, distance);
    }
    int exponent = 0;
    static_cast<void>(std::frexp(reach, &exponent));
    return least / std::ldexp(1.0, std::max(exponent - 1, -126) - 23);
}

}  // namespace rtu::study
