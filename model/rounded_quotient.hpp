#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "model/exact_sum.hpp"

namespace rtu::model {

/// A number that is not known exactly: within `error` of `value`, and half an ulp of it.
struct Bounded {
    double value = 0;
    double error = 0;
};

/// What a quotient's nearest binary32 may be: this or something between.
struct QuotientEnds {
    float low = 0, high = 0;
    /// The quotient rounds to low, sign of zero included.
    [[nodiscard]] bool are_equal() const {
        return std::bit_cast<std::uint32_t>(low) == std::bit_cast<std::uint32_t>(high);
    }
};

/// Rounds both ends of the interval that holds numerator / denominator. Requires an error of the denominator
/// below 2^-30 of it, inverse = 1 / denominator.value, and that nothing here leaves the range of normal
/// doubles: docs/model.md, rounding once.
[[nodiscard]] inline QuotientEnds quotient_ends(Bounded numerator, Bounded denominator, double inverse) {
    const double quotient = numerator.value * inverse, size = std::fabs(quotient);
    const double error = std::fabs(inverse) * (numerator.error + size * denominator.error) + 0x1p-50 * size;
    return {float(quotient - error), float(quotient + error)};
}

/// Half way between two neighbouring floats, the infinite one taken for 2^128: exact.
[[nodiscard]] inline double middle(QuotientEnds neighbours) {
    const auto widen = [](float x) { return std::isinf(x) ? std::copysign(0x1p128, x) : double(x); };
    return 0.5 * (widen(neighbours.low) + widen(neighbours.high));
}

/// The binary32 nearest to numerator / denominator, of two equally near ones the even one: the exact quotient
/// rounded once, as IEEE 754 rounds, subnormals and infinity included. An exact zero is +0. Requires a
/// denominator that is not zero, and sums below 2^400 of multiples of 2^-450.
template <std::size_t N, std::size_t M>
[[nodiscard]] float rounded_quotient(const ExactSum<N>& numerator, const ExactSum<M>& denominator) {
    const double above = numerator.value(), below = denominator.value();
    if (above == 0) return 0;
    const QuotientEnds ends = quotient_ends({above}, {below}, 1 / below);
    if (ends.are_equal()) return ends.low;
    // numerator - middle * denominator, whose products are split into a double and its rounding error.
    const double factor = -middle(ends);
    ExactSum<N + 2 * M> rest;
    for (const double component : numerator.components()) rest.add(component);
    for (const double component : denominator.components()) {
        const double product = component * factor;
        rest.add(product);
        rest.add(std::fma(component, factor, -product));
    }
    const double side = rest.value();
    if (side == 0) return (std::bit_cast<std::uint32_t>(ends.low) & 1U) == 0 ? ends.low : ends.high;
    return (side > 0) == (below > 0) ? ends.high : ends.low;
}

}  // namespace rtu::model
