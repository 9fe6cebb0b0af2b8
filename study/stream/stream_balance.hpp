#pragma once

#include <cstdint>
#include <optional>

#include "sim/config.hpp"
#include "sim/stream_job.hpp"

namespace rtu::study {

/// What one batch of a stream takes of each part of the system, in cycles, on average over the job.
struct BatchTimes {
    double host = 0;       ///< its overhead of all transfers of the batch
    double upload = 0;     ///< on the wire
    double read_back = 0;  ///< on the wire
    double latency = 0;    ///< of all its transfers
    double machine = 0;    ///< the testers

    /// What the link takes of a batch: the sum without overlap (one buffer), else its slowest part.
    [[nodiscard]] double link(const sim::Config::Link& config) const;
    /// The time from one batch to the next in a long stream; a lower bound, that is met within 3 % unless two
    /// parts that overlap take about as long.
    [[nodiscard]] double period(const sim::Config::Link& config) const;
};

/// The closed form of sim::HostLink and sim::StreamUnit, without channels. `test_cycles`: of the testers, for
/// a pair test.
[[nodiscard]] BatchTimes batch_times(const sim::Config& config, const sim::StreamJob& job,
                                     double test_cycles);

/// The smallest `batch_tests` with which the testers take at least as long as the link does, so that the link
/// is no longer the limit; none when it always is. The job's own batch size does not matter.
[[nodiscard]] std::optional<std::uint64_t> balance_batch(const sim::Config& config, const sim::StreamJob& job,
                                                         double test_cycles);

}  // namespace rtu::study
