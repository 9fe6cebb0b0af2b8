#pragma once

#include <cstdint>

#include "sim/config.hpp"

namespace rtu::study {

/// Host memory that a simulation of this machine needs, without the image and the rays: an upper bound, in
/// bytes, from what was measured (docs/sweeps.md).
[[nodiscard]] std::uint64_t machine_bytes(const sim::Config& config);

/// Processes to start: `asked`, or else one a core; not more than points, nor than four fifths of the host's
/// free memory hold at `bytes` each, but at least one.
[[nodiscard]] unsigned worker_count(unsigned asked, std::uint64_t points, std::uint64_t bytes);

}  // namespace rtu::study
