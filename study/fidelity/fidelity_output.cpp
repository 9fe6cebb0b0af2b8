#include "study/fidelity/fidelity_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/csv.hpp"
#include "study/json_output.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

Json json(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

Json json(const FidelityRow& row) {
    Json object{{"scene", row.scene},
                {"machine", row.machine},
                {"workload", row.workload},
                {"level", row.level},
                {"mrps", row.mrps},
                {"mrps_low", row.mrps_low},
                {"mrps_high", row.mrps_high},
                {"error_percent", json(row.error_percent)},
                {"simulated_rays", row.simulated_rays},
                {"traced_rays", row.traced_rays},
                {"total_rays", row.total_rays},
                {"host_rays_per_second", row.host_rays_per_second},
                {"speedup", json(row.speedup)},
                {"account", row.account}};
    return object;
}

Json json(std::span<const FidelityRow> rows) {
    Json array = Json::array();
    for (const FidelityRow& row : rows) array.push_back(json(row));
    return array;
}

std::string cell(std::optional<double> value) { return value ? fmt::format("{:.6g}", *value) : ""; }

}  // namespace

std::string fidelity_json(const FidelityReport& report) {
    Json rankings = Json::array();
    for (const FidelityRanking& ranking : report.rankings) {
        rankings.push_back({{"scene", ranking.scene},
                            {"workload", ranking.workload},
                            {"level", ranking.level},
                            {"machines", ranking.machines},
                            {"kendall_tau", ranking.tau},
                            {"host_seconds", ranking.host_seconds}});
    }
    return json_text(
        {{"version", report.version},
         {"resolution", {{"width", report.resolution.width}, {"height", report.resolution.height}}},
         {"seed", report.seed},
         {"tolerance_percent", 100 * report.tolerance},
         {"rows", json(report.rows)},
         {"rankings", rankings}});
}

std::string estimates_json(std::span<const FidelityRow> rows) { return json_text({{"rows", json(rows)}}); }

std::string rows_csv(std::span<const FidelityRow> rows) {
    std::string out =
        csv_line({"scene", "machine", "workload", "level", "mrps", "mrps_low", "mrps_high", "error_percent",
                  "simulated_rays", "traced_rays", "total_rays", "host_rays_per_second", "speedup"});
    for (const FidelityRow& row : rows) {
        out += csv_line({row.scene, row.machine, row.workload, row.level, cell(row.mrps), cell(row.mrps_low),
                         cell(row.mrps_high), cell(row.error_percent), std::to_string(row.simulated_rays),
                         std::to_string(row.traced_rays), std::to_string(row.total_rays),
                         cell(row.host_rays_per_second), cell(row.speedup)});
    }
    return out;
}

std::string fidelity_csv(const FidelityReport& report) { return rows_csv(report.rows); }

}  // namespace rtu::study
