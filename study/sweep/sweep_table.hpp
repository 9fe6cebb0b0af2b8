#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "study/sweep/sqlite.hpp"

namespace rtu::study {

/// A column that has one type, whatever its values are: a value is of this type, or missing.
struct SweepColumn {
    enum class Type : std::uint8_t { Int64, Double, String };
    std::string name;  ///< no dots
    Type type = Type::Double;
};

/// "int64", "double" or "string".
[[nodiscard]] std::string_view to_string(SweepColumn::Type type);

/// The present points that are done, one row each, in their order. What a point is comes first; then every
/// workload's figures under WORKLOAD_NAME: "primary_mrps"; and those of "total". Nothing is nested.
struct SweepTable {
    std::vector<SweepColumn> columns;
    std::vector<std::vector<SqlValue>> rows;  ///< [][columns.size()]
};

[[nodiscard]] SweepTable sweep_table(const SqlDatabase& database);

}  // namespace rtu::study
