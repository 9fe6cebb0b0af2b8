#pragma once

#include <vector>

#include "sim/config.hpp"

namespace rtu::study {

/// Twenty machines that an architect might compare, all with the tree of `base`: box lanes, ray slots and L1
/// size in all combinations, and four that change one other number. The order means nothing.
[[nodiscard]] std::vector<sim::Config> ranked_machines(const sim::Config& base);

}  // namespace rtu::study
