#pragma once

#include <string>

namespace rtu::study {

/// Marks a database file as one of sweeps ("RTUs"), and the version of its tables.
inline constexpr int sweep_application_id = 0x52545573;
inline constexpr int sweep_schema_version = 2;

/// The statements that make the tables and the views `results` and `answers`.
[[nodiscard]] std::string sweep_schema();

}  // namespace rtu::study
