#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rtu::study {

/// A study's result as a JSON file. What is no UTF-8, as a scene's file name may be, is replaced.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document);

/// A value as a cell of CSV, not yet quoted: text without quotation marks, nothing for null.
[[nodiscard]] std::string csv_cell(const nlohmann::ordered_json& value);

/// Objects with the same keys as CSV; the keys of `names` are its header.
[[nodiscard]] std::string json_rows_csv(const nlohmann::ordered_json& names,
                                        const std::vector<nlohmann::ordered_json>& rows);

}  // namespace rtu::study
