#include "study/fidelity/fidelity_estimate.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <vector>

#include "study/fidelity/analytic_model.hpp"
#include "study/fidelity/fidelity_windows.hpp"

namespace rtu::study {
namespace {

// The places of what the cycles of blocks and windows are taken to be linear in.
namespace covariate {
enum : std::size_t { rays, boxes, pairs, hits, alone, least, count };
}
using Vector = std::array<double, covariate::count>;
using Matrix = std::array<Vector, covariate::count>;

// What keeps the units busy, and the busiest of them: ray by ray, and block by block.
Vector covariates(const sim::Config& config, const RayWork& work, double least_cycles_alone,
                  double least_cycles) {
    const bool takes_whole_nodes = config.rtu.box.boxes_per_cycle >= config.bvh.width;
    const bool takes_whole_pairs = config.rtu.pair.mode != sim::PairMode::Single;
    return {work.rays,
            takes_whole_nodes ? work.node_visits : work.box_tests,
            takes_whole_pairs ? work.pair_tests : work.triangle_tests,
            hit_unit_cycles(config, work),
            least_cycles_alone,
            least_cycles};
}

// Of a window: each covariate costs a degree of freedom, and with more than these three two dozen windows are
// off by a tenth more and their intervals hold less. Pairs and hit units are in the least cycles where they
// matter.
Vector window_covariates(const sim::Config& config, const WindowSample& window) {
    Vector x = covariates(config, window.work, 0, window.traced.least_cycles);
    x[covariate::pairs] = x[covariate::hits] = 0;
    return x;
}

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < covariate::count; ++i) sum += a[i] * b[i];
    return sum;
}

// The inverse of a symmetric, positive semi-definite matrix; directions that it does not span count as 0.
Matrix inverse(Matrix m) {
    Matrix result{};
    std::array<bool, covariate::count> is_used{};
    Vector scale{};
    for (std::size_t i = 0; i < covariate::count; ++i) {
        result[i][i] = 1;
        scale[i] = m[i][i];
    }
    for (std::size_t i = 0; i < covariate::count; ++i) {
        // A covariate that the ones before it explain but for rounding says nothing new.
        if (!(m[i][i] > 1e-9 * scale[i])) continue;
        is_used[i] = true;
        const double pivot = m[i][i];
        for (std::size_t j = 0; j < covariate::count; ++j) {
            m[i][j] /= pivot;
            result[i][j] /= pivot;
        }
        for (std::size_t k = 0; k < covariate::count; ++k) {
            const double factor = m[k][i];
            if (k == i || factor == 0) continue;
            for (std::size_t j = 0; j < covariate::count; ++j) {
                m[k][j] -= factor * m[i][j];
                result[k][j] -= factor * result[i][j];
            }
        }
    }
    for (std::size_t i = 0; i < covariate::count; ++i)
        for (std::size_t j = 0; j < covariate::count; ++j)
            if (!is_used[i] || !is_used[j]) result[i][j] = 0;
    return result;
}

struct Observation {
    double y;
    Vector x;
};

// y = beta * x by least squares, and how well that fits.
struct Fit {
    Vector beta{};
    Matrix inverse{};
    double mean_residual = 0;
    std::vector<double> residuals;
    double rank = 0;
    std::vector<Vector> x;
    Vector mean_x{};
};

Fit fit(const std::vector<Observation>& observations) {
    Matrix xx{};
    Vector xy{};
    Fit fit;
    const auto n = double(observations.size());
    for (const auto& [y, x] : observations) {
        for (std::size_t i = 0; i < covariate::count; ++i) {
            xy[i] += x[i] * y;
            fit.mean_x[i] += x[i] / n;
            for (std::size_t j = 0; j < covariate::count; ++j) xx[i][j] += x[i] * x[j];
        }
    }
    fit.inverse = inverse(xx);
    for (std::size_t i = 0; i < covariate::count; ++i) {
        fit.beta[i] = dot(fit.inverse[i], xy);
        if (fit.inverse[i][i] > 0) ++fit.rank;
    }
    for (const auto& [y, x] : observations) {
        fit.x.push_back(x);
        fit.residuals.push_back(y - dot(fit.beta, x));
        fit.mean_residual += fit.residuals.back() / n;
    }
    return fit;
}

// Of the means of values that were taken one from each of equal parts, in order: from their successive
// differences, which is never too small [Wolter07, ch. 8].
double variance_of_mean(const std::vector<double>& values) {
    if (values.size() < 2) return 0;
    double squares = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        squares += (values[i] - values[i - 1]) * (values[i] - values[i - 1]);
    }
    const auto n = double(values.size());
    return squares / (2 * (n - 1) * n);
}

// The variance of the estimate that the windows' scatter makes, and the quantile of Student's t that says how
// well it is known.
struct Scatter {
    double variance = 0;
    double quantile = 0;
};

// From so many windows on, what varies slowly along the run is no error, as windows are spread over it: only
// what neighbours differ by is. That is known less well, by two thirds of the degrees of freedom [Wolter07,
// ch. 8], and fewer windows gain nothing by it.
constexpr std::size_t fewest_neighbours = 36;

// As [Satterthwaite46], for normal errors: 3 v^2 is the mean of a fourth power, v that of its square.
double degrees_of_freedom(const std::vector<double>& errors, double most) {
    double squares = 0, fourths = 0;
    for (const double error : errors) {
        squares += error * error;
        fourths += error * error * error * error;
    }
    return fourths > 0 ? std::clamp(3 * squares * squares / fourths - 2, 1.0, most) : most;
}

// Windows do not scatter alike: those that cost more, scatter more, and the fit follows them more. So each
// counts with its own residual, enlarged for what the fit took of it: HC2 of [MW85].
Scatter scatter_of_windows(const Fit& fit, const Vector& apart) {
    const auto n = double(fit.residuals.size());
    std::vector<double> errors;  // of the estimate, by each window
    double squares = 0;
    for (std::size_t i = 0; i < fit.residuals.size(); ++i) {
        Vector solved{};
        for (std::size_t k = 0; k < covariate::count; ++k) solved[k] = dot(fit.inverse[k], fit.x[i]);
        const double weight = 1 / n + dot(apart, solved);
        const double left = std::max(1e-6, 1 - dot(fit.x[i], solved));  // of the window's own error
        errors.push_back(weight * fit.residuals[i] / std::sqrt(left));
        squares += errors.back() * errors.back();
    }
    const double freedom = degrees_of_freedom(errors, std::max(1.0, n - fit.rank));
    if (errors.size() < fewest_neighbours) return {squares, t_quantile(freedom)};
    return {n * n * variance_of_mean(errors), t_quantile(std::max(1.0, 2.0 / 3 * freedom))};
}

std::vector<WindowSample> in_order(std::span<const WindowMeasurement> passes) {
    std::vector<WindowSample> windows;
    for (const WindowMeasurement& pass : passes) {
        windows.insert(windows.end(), pass.windows.begin(), pass.windows.end());
    }
    std::ranges::stable_sort(windows, {}, &WindowSample::begin);
    return windows;
}

Fit fit_windows(const sim::Config& config, std::span<const WindowMeasurement> passes) {
    std::vector<Observation> observations;
    for (const WindowSample& window : in_order(passes)) {
        observations.push_back({window.cycles, window_covariates(config, window)});
    }
    return fit(observations);
}

// The least cycles of blocks, by their other work.
Fit fit_blocks(const sim::Config& config, std::span<const WindowMeasurement> passes) {
    std::vector<Observation> observations;
    for (const WindowMeasurement& pass : passes) {
        for (const TracedWork& block : pass.blocks) {
            observations.push_back(
                {block.least_cycles, covariates(config, block.work, block.least_cycles_alone, 0)});
        }
    }
    return fit(observations);
}

// Two phases [Cochran77, ch. 12]: the lattice tells the mean work, the blocks what the busiest unit takes
// beyond what follows from the work of their rays one by one.
class Population {
  public:
    Population(const sim::Config& config, std::span<const WindowMeasurement> passes)
        : blocks_(fit_blocks(config, passes)), block_length_(passes.front().block_length) {
        for (const WindowMeasurement& pass : passes) {
            for (const RayWork& work : pass.lattice) {
                Vector& x = lattice_.emplace_back(covariates(config, work, least_cycles(config, work), 0));
                x[covariate::least] = dot(blocks_.beta, x);
            }
        }
        for (const Vector& x : lattice_)
            for (std::size_t i = 0; i < covariate::count; ++i) mean_[i] += x[i] / double(lattice_.size());
        mean_[covariate::least] += blocks_.mean_residual / block_length_;
    }

    [[nodiscard]] const Vector& mean() const { return mean_; }  // of a position

    // Of the mean cost of a position. Rays that the lattice finds too many or too few change cycles and rays
    // alike.
    [[nodiscard]] double variance_of_cost(const Vector& beta, double cycles_per_ray) const {
        std::vector<double> values;
        values.reserve(lattice_.size());
        for (const Vector& x : lattice_) values.push_back(dot(beta, x) - cycles_per_ray * x[covariate::rays]);
        const double of_block = beta[covariate::least] / block_length_;
        return variance_of_mean(values) + of_block * of_block * variance_of_mean(blocks_.residuals);
    }

  private:
    Fit blocks_;
    double block_length_;
    std::vector<Vector> lattice_;
    Vector mean_{};
};

}  // namespace

CycleEstimate widened(CycleEstimate estimate, double bias, double above) {
    const double half = std::hypot(estimate.relative_half_width(), bias);
    estimate.low = estimate.cycles_per_ray * std::max(0.0, 1 - half);
    estimate.high = estimate.cycles_per_ray * (1 + half + above);
    return estimate;
}

double t_quantile(double degrees_of_freedom) {
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

CycleEstimate estimate_cycles(const sim::Config& config, std::span<const WindowMeasurement> passes) {
    const WindowMeasurement& begun = passes.front();
    const Fit fitted = fit_windows(config, passes);
    const Population population(config, passes);

    const auto length = double(begun.window_length);
    const auto windows = double(begun.middle_length) / length;  // in the middle
    Vector wanted{};                                            // of a window, in the mean
    Vector apart{};
    for (std::size_t i = 0; i < covariate::count; ++i) {
        wanted[i] = population.mean()[i] * length;
        apart[i] = wanted[i] - fitted.mean_x[i];
    }
    const double middle_cycles = windows * (dot(fitted.beta, wanted) + fitted.mean_residual);
    CycleEstimate estimate;
    estimate.rays = begun.first.work.rays + windows * wanted[covariate::rays] + begun.last.work.rays;
    const double cycles = begun.first.cycles + middle_cycles + begun.last.cycles;
    if (estimate.rays <= 0) return estimate;
    estimate.cycles_per_ray = cycles / estimate.rays;

    const Scatter scatter = scatter_of_windows(fitted, apart);
    // The lattice has thousands of rays: the normal distribution will do for its part.
    const double of_windows = scatter.quantile * scatter.quantile * scatter.variance;
    const double of_population =
        1.96 * 1.96 * length * length * population.variance_of_cost(fitted.beta, estimate.cycles_per_ray);
    const double half = windows * std::sqrt(of_windows + of_population) / estimate.rays;
    estimate.low = std::max(0.0, estimate.cycles_per_ray - half);
    estimate.high = estimate.cycles_per_ray + half;
    return estimate;
}

}  // namespace rtu::study
