#pragma once

#include <cstdint>
#include <limits>

namespace rtu::sim {

/// A point in time, in clock cycles from the start of the simulation.
using Cycle = std::uint64_t;

/// Later than every cycle: "never".
inline constexpr Cycle no_cycle = std::numeric_limits<Cycle>::max();

}  // namespace rtu::sim
