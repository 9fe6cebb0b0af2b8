#pragma once

#include <cstdint>
#include <span>

#include "sim/config.hpp"
#include "study/fidelity/fidelity_windows.hpp"

namespace rtu::study {

/// A run's cycles per ray, with a two-sided 95 % interval.
struct CycleEstimate {
    double cycles_per_ray = 0;
    double low = 0, high = 0;
    double rays = 0;  ///< of the whole run
    /// Half the interval over the estimate.
    [[nodiscard]] double relative_half_width() const {
        return cycles_per_ray > 0 ? (high - low) / 2 / cycles_per_ray : 0;
    }
};

/// Estimates the cycles per ray of a whole run from measurements of parts of it (at least one; windows of the
/// same length). A regression estimator [Cochran77, ch. 7]: the windows tell what their work costs, by least
/// squares on rays, box and pair tests, and the lattice tells how much work the whole workload is. The
/// interval is Student's t on the windows' residuals, widened by the uncertainty of the lattice's means. It
/// knows nothing of a bias of the windows themselves.
[[nodiscard]] CycleEstimate estimate_cycles(const sim::Config& config,
                                            std::span<const WindowMeasurement> passes);

/// Quantile 0.975 of Student's t distribution with at least one degree of freedom.
[[nodiscard]] double t_quantile(double degrees_of_freedom);

}  // namespace rtu::study
