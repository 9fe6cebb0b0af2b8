#include "model/methods/quantised_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rtu::model::methods {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Bounds anything{-infinity, infinity};

double largest_number(NumberFormat format) {
    return (2 - power_of_two(-format.mantissa_bits)) * power_of_two(format.largest_exponent());
}

double step_at(NumberFormat format, double x) {
    const int exponent = x == 0 ? format.least_exponent() : std::ilogb(x);
    return power_of_two(std::max(exponent, format.least_exponent()) - format.mantissa_bits);
}

// The greatest number of the format that is not above x.
double floored(NumberFormat format, double x) {
    if (!std::isfinite(x)) return -infinity;
    const double step = step_at(format, x);
    const double below = std::floor(x / step) * step;
    const double largest = largest_number(format);
    return below < -largest ? -infinity : std::min(below, largest);
}

double ceiled(NumberFormat format, double x) { return -floored(format, -x); }

// The interval of a number known as a binary64 one plus an error of which only the sign counts.
Bounds enclosed(NumberFormat format, double x, double error) {
    const double lo = error < 0 ? std::nextafter(x, -infinity) : x;
    const double hi = error > 0 ? std::nextafter(x, infinity) : x;
    return {floored(format, lo), ceiled(format, hi)};
}

// What rounding took from the sum s of a and b: exact, whatever their sizes [SHE97].
double sum_error(double a, double b, double s) {
    const double b_part = s - a, a_part = s - b_part;
    return (a - a_part) + (b - b_part);
}

double sum_below(NumberFormat format, double a, double b) {
    const double s = a + b;
    return enclosed(format, s, sum_error(a, b, s)).lo;
}

bool is_finite(Bounds a) { return std::isfinite(a.lo) && std::isfinite(a.hi); }

Bounds difference(NumberFormat format, Bounds a, Bounds b) {
    if (!is_finite(a) || !is_finite(b)) return anything;
    return {sum_below(format, a.lo, -b.hi), -sum_below(format, -a.hi, b.lo)};
}

// Products of two numbers of at most 24 bits are exact in binary64.
Bounds product(NumberFormat format, Bounds a, Bounds b) {
    if (!is_finite(a) || !is_finite(b)) return anything;
    const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
    return {floored(format, lo), ceiled(format, hi)};
}

Bounds exact_difference(NumberFormat format, float a, float b) {
    const double s = double(a) - double(b);
    if (!std::isfinite(s)) return anything;
    return enclosed(format, s, sum_error(double(a), -double(b), s));
}

// A quotient of two floats is never nearer to a third than 2^-49 of itself unless it is equal: binary64 has
// it on the right side.
Bounds quotient(NumberFormat format, float a, float b) {
    const double q = double(a) / double(b);
    return {floored(format, q), ceiled(format, q)};
}

bool is_positive(Bounds a) { return a.lo > 0; }
bool is_negative(Bounds a) { return a.hi < 0; }

bool are_apart(Bounds a, Bounds b, Bounds c) {
    return (is_positive(a) && is_positive(b) && is_positive(c)) ||
           (is_negative(a) && is_negative(b) && is_negative(c));
}

}  // namespace

QuantisedFilter::QuantisedFilter(const Ray& ray, NumberFormat format) : format_(format), origin_(ray.origin) {
    const Vec3 d = ray.direction;
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const int kz = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    axes_ = {(kz + 1) % 3, (kz + 2) % 3, kz};
    const auto of = [&](int k) { return d[std::size_t(axes_[std::size_t(k)])]; };
    shear_x_ = quotient(format, of(0), of(2));
    shear_y_ = quotient(format, of(1), of(2));
    // Products of two floats are exact in binary64; infinity stays what it is.
    const double from = double(ray.t_min) * double(of(2)), to = double(ray.t_max) * double(of(2));
    z_range_ = {floored(format, std::min(from, to)), ceiled(format, std::max(from, to))};
}

QuantisedFilter::Corner QuantisedFilter::seen(Vec3 vertex) const {
    const auto along = [&](std::size_t k) {
        const auto axis = std::size_t(axes_[k]);
        return exact_difference(format_, vertex[axis], origin_[axis]);
    };
    const Bounds z = along(2);
    return {difference(format_, along(0), product(format_, shear_x_, z)),
            difference(format_, along(1), product(format_, shear_y_, z)), z};
}

bool QuantisedFilter::may_hit(const Corners& triangle) const {
    const Corner a = seen(triangle[0]), b = seen(triangle[1]), c = seen(triangle[2]);
    if (are_apart(a.x, b.x, c.x) || are_apart(a.y, b.y, c.y)) return false;
    if (std::max({a.z.hi, b.z.hi, c.z.hi}) < z_range_.lo) return false;
    if (std::min({a.z.lo, b.z.lo, c.z.lo}) > z_range_.hi) return false;
    const auto edge = [&](const Corner& p, const Corner& q) {
        return difference(format_, product(format_, p.x, q.y), product(format_, p.y, q.x));
    };
    const Bounds u = edge(b, c), v = edge(c, a), w = edge(a, b);
    const bool has_positive = is_positive(u) || is_positive(v) || is_positive(w);
    const bool has_negative = is_negative(u) || is_negative(v) || is_negative(w);
    return !(has_positive && has_negative);
}

FilterOperations QuantisedFilter::operations() {
    constexpr std::uint32_t shears = 6, edges = 3;
    return {.wide_add = 9, .narrow_mul = 4 * (shears + 2 * edges), .narrow_add = 2 * (shears + edges)};
}

}  // namespace rtu::model::methods
