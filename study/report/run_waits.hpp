#pragma once

#include <cstdint>

#include "sim/config.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

/// Where a workload waited, over all RTUs; everything is 0 for no cycles. Percentages are of all cycles of
/// the units of that kind.
struct RunWaits {
    double slots = 0;        ///< ray slots there are
    double slots_taken = 0;  ///< of them, on the average
    double banks_percent = 0;
    double mshrs_percent = 0;  ///< of L1 inputs waiting for an MSHR or for room in one
    double pair_blocked_percent = 0;
    double hit_wait_cycles = 0;  ///< mean wait of a leaf that survives the first pass
    double link_percent = 0;     ///< cycles in which a batch is under way and none is in the machine
    double l1_miss_percent = 0;  ///< of line reads, those merged into a miss included
    std::uint64_t spilled_entries = 0;

    [[nodiscard]] double slots_percent() const { return slots > 0 ? 100 * slots_taken / slots : 0; }
};

[[nodiscard]] RunWaits run_waits(const WorkloadReport& workload, const sim::Config& config);

}  // namespace rtu::study
