#pragma once

#include <string>

#include "study/sweep/sqlite.hpp"

// The view `results` of the present plan as text: a row for each workload of each point that is done, in the
// order of the plan, `total` last. No host times: the same sweep gives the same bytes.

namespace rtu::study {

[[nodiscard]] std::string sweep_csv(const SqlDatabase& database);

/// A JSON array with an object for each row.
[[nodiscard]] std::string sweep_json(const SqlDatabase& database);

/// The sweep_table() for Parquet and the like: {"types": {NAME: "int64", "double" or "string"}, "columns":
/// {NAME: [...]}}, with null for what is missing.
[[nodiscard]] std::string sweep_columns(const SqlDatabase& database);

/// The sweep_table() as CSV; what is missing is empty.
[[nodiscard]] std::string sweep_points_csv(const SqlDatabase& database);

}  // namespace rtu::study
