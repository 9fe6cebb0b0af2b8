#pragma once

#include <string>

#include "study/sweep/sweep_run.hpp"

namespace rtu::study {

/// What a sweep has come to, for people: counts, failures, and the front with the keys that differ.
[[nodiscard]] std::string sweep_text(const SweepPlan& plan, const SweepOutcome& outcome,
                                     const std::string& database);

/// What a sweep would do: its points, and what they would take.
[[nodiscard]] std::string sweep_plan_text(const SweepPlan& plan, const SweepEstimate& estimate);

/// The front as JSON: objectives, and for each design its values and what differs from its preset.
[[nodiscard]] std::string front_json(const SweepPlan& plan, const SweepOutcome& outcome);

/// 95 as "1 min 35 s".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace rtu::study
