#include "study/sweep/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rtu::study {
namespace {

constexpr const char* rows_in_order =
    "SELECT * FROM results WHERE number IS NOT NULL ORDER BY number, workload = 'total', workload";

// Workloads in the order of their columns; the total last.
std::vector<std::string> workloads_of(const SqlDatabase& database) {
    SqlStatement select = database.prepare(
        "SELECT DISTINCT workload FROM results WHERE number IS NOT NULL ORDER BY workload = 'total', "
        "workload");
    std::vector<std::string> names;
    while (select.next()) names.push_back(select.text(0));
    return names;
}

SweepColumn column_of(const SqlStatement& rows, int index, const std::string& prefix) {
    SweepColumn column{prefix + rows.column_name(index), SweepColumn::Type::Double};
    std::ranges::replace(column.name, '.', '_');
    const std::string type = rows.column_type(index);
    if (type == "INTEGER") column.type = SweepColumn::Type::Int64;
    if (type == "TEXT") column.type = SweepColumn::Type::String;
    return column;
}

int index_of(const SqlStatement& rows, std::string_view name) {
    int index = 0;
    while (rows.column_name(index) != name) ++index;
    return index;
}

}  // namespace

std::string_view to_string(SweepColumn::Type type) {
    constexpr std::array<std::string_view, 3> names{"int64", "double", "string"};
    return names[std::size_t(type)];
}

SweepTable sweep_table(const SqlDatabase& database) {
    const std::vector<std::string> workloads = workloads_of(database);
    SqlStatement rows = database.prepare(rows_in_order);
    // The view has what a point is, then the workload, then its figures.
    const int workload = index_of(rows, "workload"), point = index_of(rows, "point");
    const int figures = rows.column_count() - workload - 1;
    SweepTable table;
    for (int i = 0; i < workload; ++i) table.columns.push_back(column_of(rows, i, ""));
    for (const std::string& name : workloads) {
        for (int i = 0; i < figures; ++i)
            table.columns.push_back(column_of(rows, workload + 1 + i, name + "_"));
    }
    std::string last;
    while (rows.next()) {
        if (table.rows.empty() || rows.text(point) != last) {
            last = rows.text(point);
            std::vector<SqlValue>& row = table.rows.emplace_back(table.columns.size());
            for (int i = 0; i < workload; ++i) row[std::size_t(i)] = rows.value(i);
        }
        const auto place = std::size_t(std::ranges::find(workloads, rows.text(workload)) - workloads.begin());
        const std::size_t first = std::size_t(workload) + place * std::size_t(figures);
        for (int i = 0; i < figures; ++i)
            table.rows.back()[first + std::size_t(i)] = rows.value(workload + 1 + i);
    }
    return table;
}

}  // namespace rtu::study
