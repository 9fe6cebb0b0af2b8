#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/ray.hpp"
#include "sim/clock_domain.hpp"
#include "sim/config.hpp"
#include "sim/link_counters.hpp"
#include "sim/stream_job.hpp"
#include "sim/stream_unit.hpp"
#include "sim/unit_result.hpp"

namespace rtu::sim {

/// What one stream gives.
struct StreamResult {
    Cycle cycles = 0;  ///< from the first batch sent to the last result back
    std::uint64_t batch_count = 0;
    std::vector<std::optional<model::Hit>> hits;  ///< [job.rays.size()], whatever is read back
    StreamCounters tests;
    LinkCounters link;
    LinkTime time;
    std::vector<UnitResult> units;  ///< host, link, the testers
};

/// Streams the job over `config.link` through the pair testers of all RTUs, without a BVH, and checks that
/// every test was done once and every byte arrived. `link.count` = 0 is a link that costs nothing but its
/// channels. Direct mode has one batch under way, whatever `link.buffers` says. Throws Error as StreamPlan
/// does and std::logic_error for a broken invariant. `config` must be valid. Starts a new SystemC kernel.
[[nodiscard]] StreamResult simulate_stream(const Config& config, const StreamJob& job,
                                           ClockMode mode = ClockMode::Fast);

}  // namespace rtu::sim
