#pragma once

#include <cstdint>

#include "sim/cycle.hpp"

namespace rtu::sim {

/// Cycles in a time, rounded up.
[[nodiscard]] constexpr Cycle cycles_of_ns(std::uint64_t ns, std::uint32_t clock_mhz) {
    return (ns * clock_mhz + 999) / 1000;
}

/// A wire that moves one transfer at a time. Its time is kept exactly, in fractions of a cycle, so that
/// transfers one behind the other lose nothing to rounding.
class LinkWire {
  public:
    /// Of a machine with this clock; 0: whatever is sent takes no time.
    explicit LinkWire(std::uint32_t clock_mhz) : clock_mhz_(clock_mhz) {}

    /// Sends `bytes` at `mb_per_second`, from cycle `earliest` on or when the wire is free. Returns the cycle
    /// in which all have been sent.
    Cycle send(Cycle earliest, std::uint64_t bytes, std::uint32_t mb_per_second) {
        if (whole_ < earliest) {
            whole_ = earliest;
            part_ = 0;
        } else if (part_ > 0 && mb_per_second != mb_per_second_) {
            ++whole_;  // the fraction is of another rate
            part_ = 0;
        }
        mb_per_second_ = mb_per_second;
        const std::uint64_t parts = part_ + bytes * clock_mhz_;  // MHz / (MB/s) = cycles a byte
        whole_ += parts / mb_per_second;
        part_ = parts % mb_per_second;
        return free_at();
    }
    /// The first cycle in which nothing is on the wire.
    [[nodiscard]] Cycle free_at() const { return whole_ + (part_ > 0 ? 1 : 0); }

  private:
    std::uint32_t clock_mhz_;
    Cycle whole_ = 0;
    std::uint64_t part_ = 0;  // in cycles / mb_per_second_
    std::uint32_t mb_per_second_ = 1;
};

}  // namespace rtu::sim
