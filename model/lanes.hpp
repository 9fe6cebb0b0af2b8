#pragma once

#include <cstdint>
#include <cstring>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace rtu::model {

/// N floats worked on at once (the compilers' vector extension: +, -, * and comparisons go lane by lane, with
/// the results of the scalar operations). N is 2 or 4.
template <std::uint32_t N>
struct LanesOf;
template <>
struct LanesOf<2> {
    typedef float type __attribute__((vector_size(8)));
};
template <>
struct LanesOf<4> {
    typedef float type __attribute__((vector_size(16)));
};
template <std::uint32_t N>
using Lanes = typename LanesOf<N>::type;

template <std::uint32_t N>
[[nodiscard]] inline Lanes<N> load_lanes(const float* from) {
    Lanes<N> lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

template <std::uint32_t N>
inline void store_lanes(Lanes<N> lanes, float* to) {
    std::memcpy(to, &lanes, sizeof lanes);
}

/// `value` in every lane.
template <std::uint32_t N>
[[nodiscard]] inline Lanes<N> all_lanes(float value) {
    Lanes<N> lanes;
    for (std::uint32_t i = 0; i < N; ++i) lanes[i] = value;
    return lanes;
}

/// Bit i is set where lane i of `comparison` is true.
template <std::uint32_t N, class Comparison>
[[nodiscard]] inline std::uint32_t mask_of(Comparison comparison) {
#if defined(__SSE__)  // the compilers do not find this instruction by themselves
    if constexpr (N == 4) return std::uint32_t(_mm_movemask_ps(reinterpret_cast<__m128>(comparison)));
#endif
    std::uint32_t mask = 0;
    for (std::uint32_t i = 0; i < N; ++i) mask |= std::uint32_t(comparison[i] & 1) << i;
    return mask;
}

}  // namespace rtu::model
