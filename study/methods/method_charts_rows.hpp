#pragma once

#include <cstdint>
#include <vector>

#include "study/methods/method_charts.hpp"

namespace rtu::study {

/// Every method on a closed ball of radius 16 at offsets of 1 to 1e7, rays from inside at its edges and
/// vertices. The same for the same seed whatever the number of threads.
[[nodiscard]] std::vector<OffsetRow> measure_offsets(std::uint32_t rays, std::uint64_t seed);

/// A closed mesh (`spiky`) from inside, 90 degrees wide and high: a ray a pixel, and rays at many points of
/// every edge, each in the pixel in which it lies. A pixel shows that of its rays whose hits are none, else
/// even in number, else odd.
[[nodiscard]] std::vector<ParityMap> parity_maps(std::span<const std::string> methods, std::uint32_t width,
                                                 std::uint32_t height);

}  // namespace rtu::study
