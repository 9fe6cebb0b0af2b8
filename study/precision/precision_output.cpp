#include "study/precision/precision_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/json_output.hpp"
#include "study/precision/precision_tables.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity.
Json json(std::optional<double> value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json(const PrecisionRow& row) {
    return {{"scene", row.scene},
            {"method", row.method},
            {"format", to_string(row.format)},
            {"exponent_bits", row.format.exponent_bits},
            {"mantissa_bits", row.format.mantissa_bits},
            {"tests", row.tests},
            {"false_hits", row.false_hits},
            {"false_misses", row.false_misses},
            {"rays", row.rays},
            {"wrong_rays", row.wrong()},
            {"lost_rays", row.lost},
            {"gained_rays", row.gained},
            {"moved_rays", row.moved},
            {"aimed_rays", row.aimed_rays},
            {"leaks", row.leaks},
            {"doubles", row.doubles},
            {"t_ulp_p50", json(row.t_ulp_p50)},
            {"t_ulp_p99", json(row.t_ulp_p99)},
            {"t_ulp_max", json(row.t_ulp_max)},
            {"area", json(row.area)},
            {"triangle_bits", row.triangle_bits},
            {"is_enough", row.is_enough}};
}

Json json(const FilterRow& row) {
    return {{"scene", row.scene},
            {"format", to_string(row.format)},
            {"exponent_bits", row.format.exponent_bits},
            {"mantissa_bits", row.format.mantissa_bits},
            {"tests", row.tests},
            {"hits", row.hits},
            {"passed", row.passed},
            {"false_positive_percent", row.false_positive_percent()},
            {"false_negatives", row.false_negatives},
            {"area", row.area}};
}

Json answer(const PrecisionReport& report, const PrecisionAnswer& scene) {
    return {
        {"scene", scene.scene},
        {"rays", scene.rays},
        {"workloads", scene.workloads},
        {"row", scene.row ? json(report.rows[*scene.row]) : Json(nullptr)},
        {"watertight_row", scene.watertight_row ? json(report.rows[*scene.watertight_row]) : Json(nullptr)}};
}

}  // namespace

std::string precision_text(const PrecisionReport& report) {
    std::string out = fmt::format(
        "rtusim {}  seed {}  a ray is wrong if it hits or misses unlike the exact test, or t is off by more "
        "than "
        "{:g} t\n",
        report.version, report.seed, report.t_tolerance);
    for (const PrecisionAnswer& scene : report.scenes) {
        out += fmt::format("\n{}\n", precision_answer(report, scene));
        for (const StudyTable& table : precision_tables(report, scene)) {
            TextTable text(table.columns);
            for (const auto& row : table.rows) text.add_row(row);
            out += fmt::format("\n{}\n{}", table.title, text.text());
            if (!table.note.empty()) out += table.note + "\n";
        }
    }
    return out;
}

std::string precision_json(const PrecisionReport& report) {
    Json document{{"version", report.version},
                  {"seed", report.seed},
                  {"t_tolerance", report.t_tolerance},
                  {"wrong_per_million", report.wrong_per_million}};
    for (const char* key : {"answers", "rows", "filters"}) document[key] = Json::array();
    for (const PrecisionAnswer& scene : report.scenes) document["answers"].push_back(answer(report, scene));
    for (const PrecisionRow& row : report.rows) document["rows"].push_back(json(row));
    for (const FilterRow& row : report.filters) document["filters"].push_back(json(row));
    return json_text(document);
}

std::string precision_csv(const PrecisionReport& report) {
    std::vector<Json> rows;
    for (const PrecisionRow& row : report.rows) rows.push_back(json(row));
    return json_rows_csv(json(PrecisionRow{}), rows);
}

}  // namespace rtu::study
