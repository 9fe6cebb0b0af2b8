#pragma once

#include <cstdint>
#include <span>

#include "sim/config.hpp"

namespace rtu::study {

struct WindowMeasurement;

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
/// same length), of which the first has the run's ends and the blocks. A regression estimator [Cochran77, ch.
/// 7]: the windows tell what their work costs, by least squares on rays, box tests and the cycles of the
/// busiest unit, and lattice and blocks tell how much of these the whole workload has. The interval is
/// Student's t on the windows' residuals, whose variances may differ [MW85], widened by the uncertainty of
/// these means. It knows nothing of a bias of the windows themselves.
[[nodiscard]] CycleEstimate estimate_cycles(const sim::Config& config,
                                            std::span<const WindowMeasurement> passes);

/// The same with an interval that also allows for a bias, as large and as likely on either side, and for a
/// run that takes longer than the estimate by up to `above`; both relative. The bias has nothing to do with
/// the scatter that the interval is from, so their squares add.
[[nodiscard]] CycleEstimate widened(CycleEstimate estimate, double bias, double above);

/// Quantile 0.975 of Student's t distribution with at least one degree of freedom.
[[nodiscard]] double t_quantile(double degrees_of_freedom);

}  // namespace rtu::study
