#pragma once

#include <cstdint>

#include "model/vec3.hpp"

namespace rtu::model {

/// Smooth noise in [0, 1): random values on the integer lattice, blended with a cubic between. `seed` picks
/// another noise. Coordinates in (-2^30, 2^30).
[[nodiscard]] float value_noise(Vec3 p, std::uint32_t seed);

/// Ridged noise in [0, 1]: `octaves` octaves, each half as strong and twice as fine, folded so that creases
/// become crests.
[[nodiscard]] float ridged_noise(Vec3 p, int octaves);

}  // namespace rtu::model
