#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rtu::study {

/// `want` of the numbers below `have` (all, if there are no more), in order: a random one of each of as many
/// stretches of equal length, because a fixed stride would walk down a column of a picture. `purpose` tells
/// its random numbers from those of others.
[[nodiscard]] std::vector<std::size_t> spread_sample(std::size_t have, std::size_t want, std::uint64_t seed,
                                                     std::uint32_t purpose);

}  // namespace rtu::study
