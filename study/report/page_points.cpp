#include "study/report/page_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "model/error.hpp"
#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"
#include "study/sweep/sweep_database.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// A column is of names or of numbers, with nothing where a value is missing.
void add_cell(PageField& field, std::size_t point, const PageCell& cell) {
    if (const auto* name = std::get_if<std::string>(&cell)) {
        field.names.resize(point);
        field.names.push_back(*name);
    } else {
        field.numbers.resize(point);
        field.numbers.push_back(std::holds_alternative<double>(cell) ? std::optional(std::get<double>(cell))
                                                                     : std::nullopt);
    }
}

void finish(PagePoints& points, std::size_t count) {
    for (PageField& field : points.fields) {
        if (field.names.empty()) {
            field.numbers.resize(count);
        } else {
            field.numbers.clear();
            field.names.resize(count);
        }
    }
}

PageCell cell_of_sql(const SqlValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return double(*integer);
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    return {};
}

std::string setting(const SqlDatabase& database, const std::string& key) {
    SqlStatement row = database.prepare("SELECT value FROM sweep WHERE key = ?");
    row.bind(1, key);
    return row.next() ? row.text(0) : std::string();
}

// A line for each.
std::vector<SweepObjective> objectives(const SqlDatabase& database) {
    std::istringstream lines(setting(database, "objectives"));
    std::vector<SweepObjective> result;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) result.push_back(parse_sweep_objective(line, database.file()));
    }
    return result;
}

}  // namespace

PageSection sweep_section(const Json& json) {
    PagePoints points;
    points.note =
        "A row of the export for each point and workload. An export does not say which designs are on the "
        "sweep's "
        "front: a database does.";
    for (const auto& [name, value] : json.front().items()) points.fields.push_back({name, {}, false, {}, {}});
    std::size_t count = 0;
    for (const Json& row : json) {
        for (PageField& field : points.fields) add_cell(field, count, cell_of(row, field.name));
        ++count;
    }
    finish(points, count);
    return points_section(std::move(points));
}

PageSection sweep_database_section(const std::filesystem::path& path) {
    const SweepDatabase database(path, SqlDatabase::Mode::ReadOnly);
    std::set<std::string> front;
    for (SqlStatement rows = database.sql().prepare("SELECT design FROM front"); rows.next();)
        front.insert(rows.text(0));
    SqlStatement rows = database.sql().prepare(
        "SELECT * FROM results WHERE number IS NOT NULL ORDER BY number, workload = 'total', workload");
    PagePoints points;
    for (int i = 0; i < rows.column_count(); ++i)
        points.fields.push_back({rows.column_name(i), {}, false, {}, {}});
    PageField on_front{"front", {}, false, {}, {}};
    std::size_t count = 0;
    for (; rows.next(); ++count) {
        for (int i = 0; i < rows.column_count(); ++i) {
            add_cell(points.fields[std::size_t(i)], count, cell_of_sql(rows.value(i)));
            if (points.fields[std::size_t(i)].name == "design")
                on_front.names.emplace_back(front.contains(rows.text(i)) ? "yes" : "no");
        }
    }
    if (count == 0) throw Error("{}: expected a sweep with points that are done, found none", path.string());
    points.fields.push_back(std::move(on_front));
    finish(points, count);
    points.objectives = objectives(database.sql());
    std::vector<std::string> names;
    for (const SweepObjective& objective : points.objectives) names.push_back(objective.name());
    points.note = fmt::format("Sweep {}: {} designs are on the front of {}.", setting(database.sql(), "name"),
                              front.size(), fmt::join(names, ", "));
    return points_section(std::move(points));
}

}  // namespace rtu::study
