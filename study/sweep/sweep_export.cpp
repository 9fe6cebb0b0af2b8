#include "study/sweep/sweep_export.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "study/csv.hpp"
#include "study/sweep/sweep_table.hpp"

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
    const SweepTable table = sweep_table(database);
    Json types = Json::object(), values = Json::object();
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const auto& [name, type] = table.columns[i];
        types[name] = to_string(type);
        Json column = Json::array();
        for (const std::vector<SqlValue>& row : table.rows) column.push_back(json_value(row[i]));
        values[name] = std::move(column);
    }
    return dump({{"types", types}, {"columns", values}}, -1);
}

std::string sweep_points_csv(const SqlDatabase& database) {
    const SweepTable table = sweep_table(database);
    std::vector<std::string> cells;
    for (const SweepColumn& column : table.columns) cells.push_back(column.name);
    std::string text = csv_line(cells);
    for (const std::vector<SqlValue>& row : table.rows) {
        cells.clear();
        for (const SqlValue& value : row) cells.push_back(csv_text(value));
        text += csv_line(cells);
    }
    return text;
}

}  // namespace rtu::study
