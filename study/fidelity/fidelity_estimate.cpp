#include "study/fidelity/fidelity_estimate.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <vector>

namespace rtu::study {
namespace {

constexpr std::size_t covariate_count = 3;
using Vector = std::array<double, covariate_count>;
using Matrix = std::array<Vector, covariate_count>;

// What the cycles of a window are taken to be linear in.
Vector covariates(const sim::Config& config, const RayWork& work) {
    const bool takes_whole_nodes = config.rtu.box.boxes_per_cycle >= config.bvh.width;
    const bool takes_whole_pairs = config.rtu.pair.mode != sim::PairMode::Single;
    return {work.rays, takes_whole_nodes ? work.node_visits : work.box_tests,
            takes_whole_pairs ? work.pair_tests : work.triangle_tests};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The inverse of a symmetric, positive semi-definite matrix; directions that it does not span count as 0.
Matrix inverse(Matrix m) {
    Matrix result{};
    std::array<bool, covariate_count> is_used{};
    Vector scale{};
    for (std::size_t i = 0; i < covariate_count; ++i) {
        result[i][i] = 1;
        scale[i] = m[i][i];
    }
    for (std::size_t i = 0; i < covariate_count; ++i) {
        // A covariate that the ones before it explain but for rounding says nothing new.
        if (!(m[i][i] > 1e-9 * scale[i])) continue;
        is_used[i] = true;
        const double pivot = m[i][i];
        for (std::size_t j = 0; j < covariate_count; ++j) {
            m[i][j] /= pivot;
            result[i][j] /= pivot;
        }
        for (std::size_t k = 0; k < covariate_count; ++k) {
            const double factor = m[k][i];
            if (k == i || factor == 0) continue;
            for (std::size_t j = 0; j < covariate_count; ++j) {
                m[k][j] -= factor * m[i][j];
                result[k][j] -= factor * result[i][j];
            }
        }
    }
    for (std::size_t i = 0; i < covariate_count; ++i)
        for (std::size_t j = 0; j < covariate_count; ++j)
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
    double residual_variance = 0;
    Vector mean_x{};
    double degrees_of_freedom = 1;
};

Fit fit(const std::vector<Observation>& observations) {
    Matrix xx{};
    Vector xy{};
    Fit fit;
    const auto n = double(observations.size());
    for (const auto& [y, x] : observations) {
        for (std::size_t i = 0; i < covariate_count; ++i) {
            xy[i] += x[i] * y;
            fit.mean_x[i] += x[i] / n;
            for (std::size_t j = 0; j < covariate_count; ++j) xx[i][j] += x[i] * x[j];
        }
    }
    fit.inverse = inverse(xx);
    double rank = 0;
    for (std::size_t i = 0; i < covariate_count; ++i) {
        fit.beta[i] = dot(fit.inverse[i], xy);
        if (fit.inverse[i][i] > 0) ++rank;
    }
    double squares = 0;
    for (const auto& [y, x] : observations) {
        const double residual = y - dot(fit.beta, x);
        fit.mean_residual += residual / n;
        squares += residual * residual;
    }
    fit.degrees_of_freedom = std::max(1.0, n - rank);
    fit.residual_variance = squares / fit.degrees_of_freedom;
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

}  // namespace

double t_quantile(double degrees_of_freedom) {
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

CycleEstimate estimate_cycles(const sim::Config& config, std::span<const WindowMeasurement> passes) {
    const WindowMeasurement& latest = passes.back();
    std::vector<Observation> observations;
    std::vector<Vector> lattice;
    for (const WindowMeasurement& pass : passes) {
        for (const auto& [cycles, work] : pass.windows) {
            observations.push_back({cycles, covariates(config, work)});
        }
        for (const RayWork& work : pass.lattice) lattice.push_back(covariates(config, work));
    }
    const Fit fitted = fit(observations);

    Vector mean{};  // of a position
    for (const Vector& x : lattice)
        for (std::size_t i = 0; i < covariate_count; ++i) mean[i] += x[i] / double(lattice.size());
    const auto length = double(latest.window_length);
    const auto windows = double(latest.middle_length) / length;  // in the middle
    Vector wanted{};                                             // of a window, in the mean
    Vector apart{};
    for (std::size_t i = 0; i < covariate_count; ++i) {
        wanted[i] = mean[i] * length;
        apart[i] = wanted[i] - fitted.mean_x[i];
    }
    const double middle_cycles = windows * (dot(fitted.beta, wanted) + fitted.mean_residual);
    const double middle_rays = windows * wanted[0];
    CycleEstimate estimate;
    estimate.rays = latest.first.work.rays + middle_rays + latest.last.work.rays;
    const double cycles = latest.first.cycles + middle_cycles + latest.last.cycles;
    if (estimate.rays <= 0) return estimate;
    estimate.cycles_per_ray = cycles / estimate.rays;

    double leverage = 1 / double(observations.size());
    for (std::size_t i = 0; i < covariate_count; ++i) leverage += apart[i] * dot(fitted.inverse[i], apart);
    // Rays that the lattice finds too many or too few change cycles and rays alike.
    std::vector<double> values;
    values.reserve(lattice.size());
    for (const Vector& x : lattice) values.push_back(dot(fitted.beta, x) - estimate.cycles_per_ray * x[0]);
    const double variance =
        windows * windows *
        (fitted.residual_variance * leverage + length * length * variance_of_mean(values));
    const double half = t_quantile(fitted.degrees_of_freedom) * std::sqrt(variance) / estimate.rays;
    estimate.low = std::max(0.0, estimate.cycles_per_ray - half);
    estimate.high = estimate.cycles_per_ray + half;
    return estimate;
}

}  // namespace rtu::study
