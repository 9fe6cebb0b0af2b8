#include "study/json_output.hpp"

#include <nlohmann/json.hpp>

#include "study/csv.hpp"

namespace rtu::study {

using Json = nlohmann::ordered_json;

std::string json_text(const Json& document) {
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_cell(const Json& value) {
    if (value.is_null()) return "";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string json_rows_csv(const Json& names, const std::vector<Json>& rows) {
    std::vector<std::string> cells;
    for (const auto& [name, value] : names.items()) cells.push_back(name);
    std::string text = csv_line(cells);
    for (const Json& row : rows) {
        cells.clear();
        for (const auto& [name, value] : row.items()) cells.push_back(csv_cell(value));
        text += csv_line(cells);
    }
    return text;
}

}  // namespace rtu::study
