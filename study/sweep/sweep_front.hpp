#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "study/sweep/sqlite.hpp"
#include "study/sweep/sweep_objective.hpp"

namespace rtu::study {

/// A design, and what it reaches: for each objective the geometric mean over the scenes, of all workloads of
/// a scene together, so that no scene counts for more because its numbers are larger.
struct RatedDesign {
    std::string id;
    std::vector<double> values;  ///< [objectives]
    /// [objectives] the better and the worse end of each interval; the value itself where there is none.
    std::vector<double> best{}, worst{};
    bool is_estimate = false;  ///< in some scene
};

/// The designs of the present plan that are done in every scene, in the order of the plan. An objective that
/// has no value in some scene (no ray, no cycle) leaves its design out.
[[nodiscard]] std::vector<RatedDesign> rated_designs(const SqlDatabase& database,
                                                     std::span<const SweepObjective> objectives);

/// Those that no other design beats: is as good in all objectives and better in one. The best of the first
/// objective first; of equal ones all are there.
[[nodiscard]] std::vector<RatedDesign> pareto_front(std::vector<RatedDesign> designs,
                                                    std::span<const SweepObjective> objectives);

/// The designs that should be simulated with every ray next, none of them in `confirmed`: the estimates that
/// are on the front as it looks; when there are none, all that may be on it within their intervals, because
/// no design is sure to beat them. Empty when the front is known.
[[nodiscard]] std::vector<std::string> front_to_confirm(std::vector<RatedDesign> designs,
                                                        const std::set<std::string>& confirmed,
                                                        std::span<const SweepObjective> objectives);

/// How estimates compare with the simulations of the same points.
struct SweepConfirmation {
    std::uint64_t designs = 0;  ///< that were simulated
    std::uint64_t figures = 0;  ///< workloads of these designs that were estimated before
    std::uint64_t inside = 0;   ///< of the figures, those whose interval holds what the simulation gave
    double largest_error_percent = 0;
};
[[nodiscard]] SweepConfirmation confirmation(const SqlDatabase& database);

}  // namespace rtu::study
