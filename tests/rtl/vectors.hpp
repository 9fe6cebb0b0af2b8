#pragma once

// Numbers for the RTL tests: how many vectors, and binary32 values of every kind.

#include <array>
#include <bit>
#include <cstdint>
#include <random>

#include "model/vec3.hpp"

namespace rtu::test {

/// Vectors of a test: `by_default`, or what the environment variable RTUSIM_RTL_VECTORS says.
std::uint64_t vector_count(std::uint64_t by_default);

/// Seed of a test's vectors: `by_default`, or another one for every value of RTUSIM_RTL_SEED but 0.
std::uint64_t vector_seed(std::uint64_t by_default);

inline std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }
inline float float_of(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// Equal to the bit, any NaN equal to any other.
inline bool is_same(std::uint32_t a, std::uint32_t b) {
    const auto is_nan = [](std::uint32_t x) { return (x & 0x7fffffffU) > 0x7f800000U; };
    return a == b || (is_nan(a) && is_nan(b));
}

class RandomBits {
  public:
    explicit RandomBits(std::uint64_t seed) : engine_(seed) {}
    std::uint64_t bits() { return engine_(); }
    std::uint32_t below(std::uint32_t n) { return std::uint32_t((engine_() >> 32) * n >> 32); }
    bool one_in(std::uint32_t n) { return below(n) == 0; }

    /// Any pattern at all: NaN and infinity included.
    float any() { return float_of(std::uint32_t(bits())); }
    /// Uniform in [lo, hi).
    float uniform(float lo, float hi) { return lo + (hi - lo) * float(bits() >> 40) * 0x1p-24F; }
    /// A random significand and sign, and an exponent field from `least` to `least + range - 1`.
    float of_exponent(std::uint32_t least, std::uint32_t range) {
        return float_of((std::uint32_t(bits()) & 0x807fffffU) | (least + below(range)) << 23);
    }
    /// Zeros, ones, and the ends of the ranges of subnormal, normal and infinite numbers, NaN.
    float special() {
        static constexpr std::array<std::uint32_t, 16> all{
            0x00000000, 0x80000000, 0x7f800000, 0xff800000, 0x7fc00000, 0x00000001, 0x80000001, 0x007fffff,
            0x00800000, 0x7f7fffff, 0xff7fffff, 0x3f800000, 0xbf800000, 0x3f7fffff, 0x00ffffff, 0x34000000};
        return float_of(all[below(all.size())]);
    }
    model::Vec3 point(float lo, float hi) { return {uniform(lo, hi), uniform(lo, hi), uniform(lo, hi)}; }

  private:
    std::mt19937_64 engine_;
};

}  // namespace rtu::test
