#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace rtu::model::methods {

/// A binary floating-point format of IEEE 754's kind: a sign, an exponent of 2 to 10 bits and a fraction of 1
/// to 24 bits (an implicit one before it), with subnormals, infinities and NaN.
struct NumberFormat {
    std::uint8_t exponent_bits = 8;
    std::uint8_t mantissa_bits = 23;  ///< stored; the significand has one more
    friend bool operator==(const NumberFormat&, const NumberFormat&) = default;

    /// Exponent of the least normal number: -126 for binary32.
    [[nodiscard]] constexpr int least_exponent() const { return 2 - (1 << (exponent_bits - 1)); }
    /// Exponent of the largest numbers: 127 for binary32.
    [[nodiscard]] constexpr int largest_exponent() const { return (1 << (exponent_bits - 1)) - 1; }
    /// Of a number as it is stored, sign included.
    [[nodiscard]] constexpr int width_bits() const { return 1 + exponent_bits + mantissa_bits; }
};

inline constexpr NumberFormat binary32{8, 23};

/// What the format is called, "fp32" or "bf16", if it has a name; else its bits: "e8m12".
[[nodiscard]] std::string to_string(NumberFormat format);

/// 2^exponent, for exponents of normal binary64 numbers: -1022 to 1023.
[[nodiscard]] inline double power_of_two(int exponent) {
    return std::bit_cast<double>(std::uint64_t(exponent + 1023) << 52);
}

/// `x` rounded to the nearest number of the format, ties to even; beyond its largest number infinity, below
/// its least normal one gradually to zero, whose sign stays. NaN stays NaN.
[[nodiscard]] inline double rounded(NumberFormat format, double x) {
    const double size = std::abs(x);
    const int least = format.least_exponent();
    if (size < power_of_two(least)) {
        // Adding a number whose last place is the format's least step rounds to that step.
        const double step = 1.5 * power_of_two(least - format.mantissa_bits + 52);
        return std::copysign((size + step) - step, x);
    }
    if (!(size <= std::numeric_limits<double>::max())) return x;  // infinity, NaN
    const int dropped = 52 - format.mantissa_bits;
    auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t last_place = std::uint64_t(1) << dropped;
    bits += (last_place >> 1) - 1 + ((bits >> dropped) & 1);  // may carry into the exponent, as it should
    const double result = std::bit_cast<double>(bits & ~(last_place - 1));
    if (std::abs(result) < power_of_two(format.largest_exponent() + 1)) return result;
    return std::copysign(std::numeric_limits<double>::infinity(), x);
}

}  // namespace rtu::model::methods
