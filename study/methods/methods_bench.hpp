#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "study/methods/methods_report.hpp"
#include "study/methods/methods_workload.hpp"

namespace rtu::study {

/// Told how much of the measuring is done, from 0 to 1.
using MethodsProgress = std::function<void(double share)>;

/// Speeds of the kernels on rays that are all tested against all triangles. Every kernel makes several passes
/// over the same rays, and all kernels take turns `repeats` times; of each figure the least CPU time counts,
/// so that noise on the machine hits all alike.
[[nodiscard]] std::vector<MethodsRow> measure_methods(std::span<const model::methods::Kernel> kernels,
                                                      const MethodsWorkload& workload, std::uint32_t repeats,
                                                      const MethodsProgress& progress);

/// Scalar code of `method` on 2^14, 2^16, ..., 2^22 tests.
[[nodiscard]] std::vector<MethodsScalingRow> measure_scaling(const model::methods::Kernel& kernel,
                                                             std::uint64_t seed, std::uint32_t repeats);

/// The core's clock in Hz: additions of which each waits for the one before, one a cycle.
[[nodiscard]] double measure_clock_hz();

/// CPU time of this thread in seconds.
[[nodiscard]] double thread_cpu_seconds();

}  // namespace rtu::study
