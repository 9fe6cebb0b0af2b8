#include <algorithm>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "sim/config_keys.hpp"
#include "study/report/result_diff.hpp"
#include "study/sweep/sweep_database.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// Every number below `json`, by its path with dots.
void collect_numbers(const Json& json, const std::string& path, std::map<std::string, double>& numbers) {
    if (json.is_number()) numbers[path] = json.get<double>();
    if (!json.is_object()) return;
    for (const auto& [name, value] : json.items()) {
        collect_numbers(value, path.empty() ? name : fmt::format("{}.{}", path, name), numbers);
    }
}

void add_scene(const Json& report, ResultSet& result) {
    const std::string scene = text_of(report.at("scene").at("name"));
    for (const char* name : {"version", "preset", "input_hash", "seed", "resolution", "camera"}) {
        result.inputs[fmt::format("{} {}", scene, name)] = text_of(report.at(name));
    }
    for (const char* name : {"method", "edge_identity"})
        result.inputs[fmt::format("{} pairing {}", scene, name)] = text_of(report.at("pairing").at(name));
    for (const auto& [key, value] : report.at("config").items())
        result.inputs[fmt::format("{} {}", scene, key)] = text_of(value);
    for (const Json& workload : report.at("workloads")) {
        collect_numbers(workload, "", result.rows[fmt::format("{} {}", scene, text_of(workload.at("name")))]);
    }
    collect_numbers(report.at("total"), "", result.rows[scene + " total"]);
}

ResultSet load_run(const std::string& text, const std::string& file) try {
    const Json json = Json::parse(text);
    ResultSet result;
    if (json.is_array()) {
        for (const Json& report : json) add_scene(report, result);
    } else {
        add_scene(json, result);
    }
    return result;
} catch (const Json::exception&) {
    throw Error("{}: expected a report of `rtusim run --json` or a database of sweeps", file);
}

// Columns that say what a row is, not what it gave.
bool is_result(const std::string& column) {
    if (column == "number") return false;
    return std::ranges::find(sim::config_keys(), column, &sim::ConfigKey::name) == sim::config_keys().end();
}

ResultSet load_sweep(const fs::path& path) {
    const SweepDatabase database(path, SqlDatabase::Mode::ReadOnly);
    ResultSet result;
    result.is_sweep = true;
    SqlStatement about = database.sql().prepare(
        "SELECT DISTINCT scene, scene_hash, rays, version FROM point WHERE number IS NOT NULL");
    while (about.next()) {
        result.inputs[about.text(0) + " scene_hash"] = about.text(1);
        result.inputs[about.text(0) + " rays"] = about.text(2);
        result.inputs["version"] = about.text(3);
    }
    SqlStatement rows = database.sql().prepare(
        "SELECT scene || ' ' || design || ' ' || workload || iif(fidelity = 'cycle', '', ' ' || fidelity), *"
        " FROM results WHERE number IS NOT NULL");
    while (rows.next()) {
        std::map<std::string, double>& numbers = result.rows[rows.text(0)];
        for (int i = 1; i < rows.column_count(); ++i) {
            const SqlValue value = rows.value(i);
            const bool is_number =
                std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
            if (is_number && is_result(rows.column_name(i))) numbers[rows.column_name(i)] = rows.real(i);
        }
    }
    return result;
}

}  // namespace

ResultSet load_result(const fs::path& path) {
    constexpr std::uint64_t max_report_bytes = 1U << 28;
    model::RegularFile file(path);
    std::string text(std::min<std::uint64_t>(file.size_bytes(), max_report_bytes), '\0');
    file.read(text.data(), text.size());
    if (text.starts_with("SQLite format 3")) return load_sweep(path);
    return load_run(text, path.string());
}

}  // namespace rtu::study
