#include "study/sweep/sweep_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "study/csv.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

SqlStatement all_rows(const SqlDatabase& database) {
    return database.prepare(
        "SELECT * FROM results WHERE number IS NOT NULL ORDER BY number, workload = 'total', workload");
}

std::vector<std::string> names(const SqlStatement& rows) {
    std::vector<std::string> result;
    for (int i = 0; i < rows.column_count(); ++i) result.push_back(rows.column_name(i));
    return result;
}

std::string csv_text(const SqlValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    return "";
}

Json json_value(const SqlValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    return nullptr;
}

const char* type_name(const SqlValue& value) {
    if (std::holds_alternative<std::int64_t>(value)) return "int64";
    return std::holds_alternative<std::string>(value) ? "string" : "double";
}

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string sweep_csv(const SqlDatabase& database) {
    SqlStatement rows = all_rows(database);
    std::string text = csv_line(names(rows));
    while (rows.next()) {
        std::vector<std::string> cells;
        for (int i = 0; i < rows.column_count(); ++i) cells.push_back(csv_text(rows.value(i)));
        text += csv_line(cells);
    }
    return text;
}

std::string sweep_json(const SqlDatabase& database) {
    SqlStatement rows = all_rows(database);
    const std::vector<std::string> columns = names(rows);
    Json array = Json::array();
    while (rows.next()) {
        Json object = Json::object();
        for (std::size_t i = 0; i < columns.size(); ++i) object[columns[i]] = json_value(rows.value(int(i)));
        array.push_back(std::move(object));
    }
    return dump(array, 1);
}

std::string sweep_columns(const SqlDatabase& database) {
    SqlStatement rows = all_rows(database);
    std::vector<std::string> columns = names(rows);
    for (std::string& name : columns) std::ranges::replace(name, '.', '_');
    Json types = Json::object(), values = Json::object();
    for (const std::string& name : columns) values[name] = Json::array();
    while (rows.next()) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const SqlValue value = rows.value(int(i));
            values[columns[i]].push_back(json_value(value));
            const bool is_null = std::holds_alternative<std::monostate>(value);
            if (!is_null || !types.contains(columns[i])) types[columns[i]] = type_name(value);
        }
    }
    return dump({{"types", types}, {"columns", values}}, -1);
}

}  // namespace rtu::study
