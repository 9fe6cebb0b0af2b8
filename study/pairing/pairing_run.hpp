#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/config.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

/// How much of what a part of the machine can do was used, in percent of all cycles.
struct PartUse {
    std::string part;
    double percent = 0;
};

/// One pairing on one machine, all workloads together: raw counts, and how busy the parts were.
struct PairingRun {
    PairingFacts pairing;
    BvhFacts bvh;
    std::uint32_t clock_mhz = 0;
    WorkloadReport total;          ///< sums; no units, no memory
    std::uint64_t l1_misses = 0;   ///< line reads that sent a request to the L2, all L1s together
    std::uint64_t l2_misses = 0;   ///< line reads that sent a request to the DRAM
    std::uint64_t dram_bytes = 0;  ///< read and written
    std::vector<PartUse> uses;     ///< part_uses() of the workloads

    [[nodiscard]] double mrps() const { return study::mrps(total.ray_count, total.cycles, clock_mhz); }
};

/// How much each part was used, over all workloads, in the order host, scheduler, box, pair, l1, l2, dram:
/// each is work done / (cycles * what the parts of that kind can do in a cycle). host: rays handed over;
/// scheduler: fetches sent; box: cycles in which whole nodes fill the lanes; pair: cycles in which testers
/// are held; l1, l2: accesses and fills of banks; dram: cycles of data on the bus. 0 for no cycles.
[[nodiscard]] std::vector<PartUse> part_uses(std::span<const WorkloadReport> workloads,
                                             const sim::Config& config);

/// The most used part, the first of equals; what `bound by` shows. Far below 100 % it says that nothing is
/// full: rays wait for latencies. `uses` must not be empty.
[[nodiscard]] const PartUse& busiest(std::span<const PartUse> uses);

/// Adds up the workloads of one image on one machine.
[[nodiscard]] PairingRun pairing_run(const PairingFacts& pairing, const BvhFacts& bvh,
                                     std::span<const WorkloadReport> workloads, const sim::Config& config);

}  // namespace rtu::study
