#pragma once

#include <bit>
#include <cstdint>

namespace rtu::model {

/// a * b - c * d, rounded once to binary32 (nearest, ties to even): what a fused two-term dot product unit
/// gives. In particular its sign is exact, and it is zero only when the products are equal, or too close for
/// binary32 to tell. Finite operands give a finite result or, beyond binary32's range, an infinity.
[[nodiscard]] inline float difference_of_products(float a, float b, float c, float d) {
    // The products are exact in binary64, whose difference is rounded once; `error` is what that rounding
    // lost.
    const double p = double(a) * double(b);
    const double q = double(c) * double(d);
    const double difference = p - q;
    const double virtual_q = p - difference;
    const double error = (p - (difference + virtual_q)) + (virtual_q - q);
    // Rounding to odd before the second rounding makes the two the same as one [BM08].
    const auto bits = std::bit_cast<std::int64_t>(difference);
    const std::int64_t step = (error > 0.0) == (difference > 0.0) ? 1 : -1;
    const std::int64_t is_moved = std::int64_t(error != 0.0) & ~bits & 1;
    return float(std::bit_cast<double>(bits + step * is_moved));
}

}  // namespace rtu::model
