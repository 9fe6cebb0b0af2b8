#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "study/csv.hpp"
#include "study/stability/stability_run.hpp"

namespace rtu::study {
namespace {

using Row = const StabilityRow&;
using Cell = StabilityCell;

Cell when(bool is_measured, std::uint64_t count) { return is_measured ? Cell(count) : Cell(); }
Cell of(std::optional<double> value) { return value ? Cell(*value) : Cell(); }
Cell per_million(bool is_measured, std::uint64_t count, std::uint64_t rays) {
    return is_measured ? Cell(1e6 * double(count) / double(rays)) : Cell();
}
Cell largest(const ErrorHistogram& errors) { return errors.count() > 0 ? Cell(errors.max()) : Cell(); }

constexpr std::array<StabilityField, 28> fields{{
    {"rays", [](Row r) { return Cell(r.tally.rays); }},
    {"hits", [](Row r) { return Cell(r.tally.hits); }},
    {"leaks", [](Row r) { return when(r.measured.crossings, r.tally.leaks); }},
    {"doubles", [](Row r) { return when(r.measured.doubles, r.tally.doubles); }},
    {"parity_errors", [](Row r) { return when(r.measured.crossings, r.tally.parity_errors); }},
    {"leaks_per_million",
     [](Row r) { return per_million(r.measured.crossings, r.tally.leaks, r.tally.rays); }},
    {"doubles_per_million",
     [](Row r) { return per_million(r.measured.doubles, r.tally.doubles, r.tally.rays); }},
    {"parity_errors_per_million",
     [](Row r) { return per_million(r.measured.crossings, r.tally.parity_errors, r.tally.rays); }},
    {"false_hits", [](Row r) { return when(r.measured.triangles, r.tally.false_hits); }},
    {"false_misses", [](Row r) { return when(r.measured.triangles, r.tally.false_misses); }},
    {"false_hit_margin_ulps",
     [](Row r) { return r.measured.triangles ? Cell(r.tally.false_hit_margin) : Cell(); }},
    {"false_miss_margin_ulps",
     [](Row r) { return r.measured.triangles ? Cell(r.tally.false_miss_margin) : Cell(); }},
    {"wrong_owners", [](Row r) { return when(r.measured.triangles, r.tally.wrong_owners); }},
    {"non_finite", [](Row r) { return when(r.measured.triangles, r.tally.non_finite); }},
    {"self_hits", [](Row r) { return when(r.measured.self_hits, r.tally.self_hits); }},
    {"variant_errors", [](Row r) { return when(r.measured.variants, r.tally.variant_errors); }},
    {"order_errors", [](Row r) { return when(r.measured.order, r.tally.order_errors); }},
    {"box_errors", [](Row r) { return when(r.measured.boxes, r.tally.box_errors); }},
    {"failures", [](Row r) { return Cell(failures(r.measured, r.tally)); }},
    {"failures_per_million",
     [](Row r) { return per_million(true, failures(r.measured, r.tally), r.tally.rays); }},
    {"t_ulp_p50", [](Row r) { return of(r.tally.t_ulp.quantile(0.5)); }},
    {"t_ulp_p99", [](Row r) { return of(r.tally.t_ulp.quantile(0.99)); }},
    {"t_ulp_p999", [](Row r) { return of(r.tally.t_ulp.quantile(0.999)); }},
    {"t_ulp_max", [](Row r) { return largest(r.tally.t_ulp); }},
    {"uv_ulp_p50", [](Row r) { return of(r.tally.uv_ulp.quantile(0.5)); }},
    {"uv_ulp_p99", [](Row r) { return of(r.tally.uv_ulp.quantile(0.99)); }},
    {"uv_ulp_p999", [](Row r) { return of(r.tally.uv_ulp.quantile(0.999)); }},
    {"uv_ulp_max", [](Row r) { return largest(r.tally.uv_ulp); }},
}};

using Json = nlohmann::ordered_json;

Json json(const StabilityCell& cell) {
    if (const auto* count = std::get_if<std::uint64_t>(&cell)) return *count;
    if (const auto* value = std::get_if<double>(&cell)) return *value;
    return nullptr;
}

std::string csv(const StabilityCell& cell) {
    if (const auto* count = std::get_if<std::uint64_t>(&cell)) return fmt::format("{}", *count);
    if (const auto* value = std::get_if<double>(&cell)) return fmt::format("{}", *value);
    return "";
}

}  // namespace

std::span<const StabilityField> stability_fields() { return fields; }

std::string stability_json(const StabilityReport& report) {
    Json document{{"version", report.version},
                  {"compiler", report.compiler},
                  {"seed", report.seed},
                  {"rays", report.rays},
                  {"scene", report.scene.empty() ? Json(nullptr) : Json(report.scene)},
                  {"methods", report.methods},
                  {"cases", Json::array()},
                  {"rows", Json::array()}};
    for (const StabilityCaseInfo& one : report.cases) {
        document["cases"].push_back(
            {{"number", one.number}, {"name", one.name}, {"title", one.title}, {"check", one.check}});
    }
    for (const StabilityRow& row : report.rows) {
        Json object{{"method", row.method},
                    {"contraction", row.contraction},
                    {"case", report.cases[row.case_index].name},
                    {"case_number", report.cases[row.case_index].number},
                    {"parameter", row.parameter},
                    {"aim", row.aim}};
        for (const StabilityField& field : fields) object[std::string(field.key)] = json(field.value(row));
        document["rows"].push_back(std::move(object));
    }
    // A scene's name is a file's name, and that need not be UTF-8.
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stability_csv(const StabilityReport& report) {
    std::vector<std::string> header{"method", "contraction", "case", "case_number", "parameter", "aim"};
    for (const StabilityField& field : fields) header.emplace_back(field.key);
    std::string out = csv_line(std::move(header));
    for (const StabilityRow& row : report.rows) {
        const StabilityCaseInfo& one = report.cases[row.case_index];
        std::vector<std::string> cells{
            row.method, row.contraction, one.name, fmt::format("{}", one.number), row.parameter, row.aim};
        for (const StabilityField& field : fields) cells.push_back(csv(field.value(row)));
        out += csv_line(std::move(cells));
    }
    return out;
}

}  // namespace rtu::study
