#pragma once

#include <optional>
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
};

/// The designs of the present plan that are done in every scene, in the order of the plan. An objective that
/// has no value in some scene (no ray, no cycle) leaves its design out.
[[nodiscard]] std::vector<RatedDesign> rated_designs(const SqlDatabase& database,
                                                     std::span<const SweepObjective> objectives);

/// Those that no other design beats: is as good in all objectives and better in one. The best of the first
/// objective first; of equal ones all are there.
[[nodiscard]] std::vector<RatedDesign> pareto_front(std::vector<RatedDesign> designs,
                                                    std::span<const SweepObjective> objectives);

}  // namespace rtu::study
