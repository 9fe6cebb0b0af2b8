#include "study/oracle/oracle_rational.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace rtu::study {
namespace {

NumberVector<Rational> widen(model::Vec3 v) {
    return {Rational(double(v.x)), Rational(double(v.y)), Rational(double(v.z))};
}

}  // namespace

RationalMeeting meet_exactly(const model::Ray& ray, const model::methods::Corners& corners) {
    const ExactMeeting<Rational> exact(widen(ray.origin), widen(ray.direction),
                                       {widen(corners[0]), widen(corners[1]), widen(corners[2])},
                                       largest_axis(ray.direction));
    RationalMeeting result{exact.meeting(), exact.feature(), exact.is_owner(), 0, 0, 0, {}};
    for (std::size_t i = 0; i < 3; ++i) result.weights[i] = exact.weight(i);
    if (result.meeting == Meeting::Interior || result.meeting == Meeting::Edge ||
        result.meeting == Meeting::Vertex) {
        result.t = exact.before() / exact.along();
        result.u = exact.weight(1) / exact.along();
        result.v = exact.weight(2) / exact.along();
    }
    return result;
}

bool is_in_interval(const model::Ray& ray, const Rational& t) {
    const bool is_above = std::isinf(ray.t_min) ? ray.t_min < 0 : t > Rational(double(ray.t_min));
    if (std::isinf(ray.t_max)) return is_above && ray.t_max > 0 && t < Rational(first_to_round_to_infinity);
    return is_above && t < Rational(double(ray.t_max));
}

float rounded_to_float(const Rational& value) {
    constexpr float largest = std::numeric_limits<float>::max();
    const Rational size = abs(value);
    if (size >= Rational(first_to_round_to_infinity)) return value < 0 ? -INFINITY : INFINITY;
    // Positive floats are ordered like their bits: the largest one that is not above the value.
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(largest);
    while (low < high) {
        const std::uint32_t middle = low + (high - low + 1) / 2;
        if (Rational(double(std::bit_cast<float>(middle))) <= size) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    const double below = std::bit_cast<float>(low);
    const double above =
        low == std::bit_cast<std::uint32_t>(largest) ? 0x1p128 : std::bit_cast<float>(low + 1);
    const Rational middle = (Rational(below) + Rational(above)) / 2;
    const bool is_up = size > middle || (size == middle && (low & 1U) != 0);
    const auto nearest = float(is_up ? above : below);
    return value < 0 ? -nearest : nearest;
}

}  // namespace rtu::study
