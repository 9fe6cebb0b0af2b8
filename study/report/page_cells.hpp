#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/report/page_content.hpp"

// From results in JSON to cells of charts.

namespace rtu::study {

/// The number, or no cell.
[[nodiscard]] PageCell cell_of(std::optional<double> value);

/// The number or name under `key`; null is no cell. Throws Json::exception when it is missing or anything
/// else.
[[nodiscard]] inline PageCell cell_of(const nlohmann::ordered_json& object, const std::string& key) {
    const nlohmann::ordered_json& value = object.at(key);
    if (value.is_null()) return {};
    if (value.is_string()) return value.get<std::string>();
    return value.get<double>();
}

/// `cell_of` for each key.
[[nodiscard]] inline std::vector<PageCell> cells_of(const nlohmann::ordered_json& object,
                                                    const std::vector<std::string>& keys) {
    std::vector<PageCell> cells;
    for (const std::string& key : keys) cells.push_back(cell_of(object, key));
    return cells;
}

/// The name under `key`. Throws Json::exception.
[[nodiscard]] inline std::string text_at(const nlohmann::ordered_json& object, const std::string& key) {
    return object.at(key).get<std::string>();
}

/// The number under `key`. Throws Json::exception.
[[nodiscard]] inline double number_at(const nlohmann::ordered_json& object, const std::string& key) {
    return object.at(key).get<double>();
}

/// The middle value, of an even number the lower of both in the middle. `values` must not be empty.
[[nodiscard]] double median_of(std::vector<double> values);

}  // namespace rtu::study
