#pragma once

#include <cstdint>

namespace rtu::sim {

/// Where a unit's cycles went; the four sum to the cycles simulated.
struct CycleAccount {
    std::uint64_t busy = 0;
    std::uint64_t starved = 0;  ///< waiting between its first and its last work
    std::uint64_t blocked = 0;
    std::uint64_t idle = 0;  ///< waiting before its first work or after its last
    [[nodiscard]] std::uint64_t total() const { return busy + starved + blocked + idle; }
    friend bool operator==(const CycleAccount&, const CycleAccount&) = default;
};

}  // namespace rtu::sim
