#pragma once

#include <vector>

#include "sim/config.hpp"
#include "study/report/page_content.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

/// From this use on, in percent of all cycles, a part of the machine is called full.
inline constexpr double full_percent = 85;

/// What a workload's counters say about its machine.
enum class RunLimit : std::uint8_t {
    NoWork,       ///< no ray or no cycle
    Part,         ///< a part is full: the busiest of part_uses()
    Link,         ///< most of the time rays or hits are on the host link and the machine has no work
    PairEntries,  ///< leaves wait for the pair unit, whose entries wait for hit units
    Mshrs,        ///< misses wait for MSHRs of the L1
    Banks,        ///< requests wait for banks of the L1
    TooFewRays,   ///< nothing of these, and ray slots are free
    Latency,      ///< nothing of these: rays wait for latencies
};

/// The limit of one workload: the first that holds, in the order of the enumerators. `Part` from full_percent
/// on; `Link` when transfers take half of the cycles; `PairEntries` when the pair unit is blocked in a fifth
/// of its cycles; `Mshrs` and `Banks` when L1 inputs wait so in a tenth and two fifths of the cycles of an
/// L1; `TooFewRays` when fewer than nine tenths of the slots are taken. docs/report_page.md says what
/// following the advice gained on real scenes, which these thresholds are from.
[[nodiscard]] RunLimit limit_of(const WorkloadReport& workload, const sim::Config& config);

/// For people: a finding for each limit of a scene with the workloads that have it, then what else stands
/// out: stack entries in memory, few triangles in pairs, a failed check.
[[nodiscard]] std::vector<PageFinding> run_findings(const SceneReport& report, const sim::Config& config);

}  // namespace rtu::study
