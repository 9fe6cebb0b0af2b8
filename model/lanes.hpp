#pragma once

#include <cstdint>
#include <cstring>

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

}  // namespace rtu::model
