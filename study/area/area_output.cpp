#include "study/area/area_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/config_keys.hpp"
#include "study/area/area_charts.hpp"
#include "study/area/area_tables.hpp"
#include "study/chart/html_page.hpp"
#include "study/csv.hpp"
#include "study/json_output.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

Json json(const GateCounts& gates) {
    return {{"gates", gates.gates},
            {"register_bits", gates.register_bits},
            {"register_gates", gates.register_gates},
            {"multipliers", gates.multipliers},
            {"adders", gates.adders},
            {"depth", gates.depth}};
}

Json json(const AreaTotal& area) {
    Json document = json(area.gates);
    document["sram_bits"] = area.sram_bits;
    return document;
}

Json json(const AreaPart& part) {
    Json document{{"unit", part.unit}, {"part", part.name}, {"copies", part.copies}};
    document.update(json(AreaTotal{part.gates(), part.sram_bits()}));
    document["is_counted"] = part.is_counted;
    document["how"] = part.how;
    return document;
}

Json json(const MachineArea& area) {
    Json document{{"name", area.machine.name},
                  {"rtu_count", area.machine.config.rtu.count},
                  {"clock_mhz", area.machine.config.clock_mhz},
                  {"gates", area.gates()},
                  {"rtu", json(area.rtu())},
                  {"parts", Json::array()}};
    for (const AreaPart& part : area.parts) document["parts"].push_back(json(part));
    return document;
}

Json json(const ModeArea& mode) {
    return {{"mode", sim::pair_mode_names()[std::size_t(mode.mode)]},
            {"pair", json(mode.pair)},
            {"machine_gates", mode.machine_gates}};
}

Json json(const AreaRow& row) {
    return {{"scene", row.scene},
            {"workload", row.workload},
            {"mode", sim::pair_mode_names()[std::size_t(row.mode)]},
            {"rays", row.rays},
            {"cycles", row.cycles},
            {"pair_tests", row.pair_tests},
            {"triangle_tests", row.triangle_tests},
            {"exact_tests", row.exact_tests},
            {"replays", row.replays},
            {"survivors", row.survivors},
            {"tester_cycles", row.tester_cycles},
            {"hit_unit_cycles", row.hit_unit_cycles},
            {"mrps", row.mrps},
            {"mrps_per_mgate", row.mrps_per_mgate},
            {"pair_limit_mrps", row.pair_limit_mrps},
            {"pair_limit_mrps_per_mgate", row.pair_limit_mrps_per_mgate}};
}

std::string cell(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::vector<std::string> keys_of(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

// `table`, `machine`, then the cells of a part, then those of a row: one of them stays empty.
std::vector<std::string> csv_cells(std::string table, std::string machine, const Json& part,
                                   const Json& row) {
    std::vector<std::string> cells{std::move(table), std::move(machine)};
    const auto add = [&](const Json& object, const Json& empty) {
        for (const std::string& key : keys_of(empty))
            cells.push_back(object.is_null() ? "" : cell(object[key]));
    };
    add(part, json(AreaPart{}));
    add(row, json(AreaRow{}));
    return cells;
}

std::vector<std::string> csv_header() {
    std::vector<std::string> header{"table", "machine"};
    for (const Json& object : {json(AreaPart{}), json(AreaRow{})}) {
        for (std::string& key : keys_of(object)) header.push_back(std::move(key));
    }
    return header;
}

std::string heading(const AreaReport& report) {
    const std::string_view mode =
        sim::pair_mode_names()[std::size_t(report.machine.machine.config.rtu.pair.mode)];
    return fmt::format("rtusim {}  machine {}, {}  gates: NAND2 equivalents of {}  seed {}", report.version,
                       report.machine.machine.name, mode, gate_counter(), report.seed);
}

}  // namespace

std::string area_text(const AreaReport& report) {
    std::string out = fmt::format("{}\n\n{}\n", heading(report), area_answer(report));
    for (const StudyTable& table : area_tables(report)) {
        TextTable text(table.columns);
        for (const auto& row : table.rows) row.empty() ? text.add_rule() : text.add_row(row);
        out += fmt::format("\n{}\n{}", table.title, text.text());
        if (!table.note.empty()) out += table.note + "\n";
    }
    return out;
}

std::string area_json(const AreaReport& report) {
    Json document{{"version", report.version},
                  {"seed", report.seed},
                  {"gate_counter", gate_counter()},
                  {"machine", json(report.machine)}};
    for (const char* key : {"units", "presets", "modes", "rows"}) document[key] = Json::array();
    for (const CountedUnit& unit : counted_units()) {
        Json& row = document["units"].emplace_back(Json{{"unit", unit.name}});
        row.update(json(unit.counts));
    }
    for (const MachineArea& preset : report.presets) document["presets"].push_back(json(preset));
    for (const ModeArea& mode : report.modes) document["modes"].push_back(json(mode));
    for (const AreaRow& row : report.rows) document["rows"].push_back(json(row));
    return json_text(document);
}

std::string area_csv(const AreaReport& report) {
    std::string out = csv_line(csv_header());
    const auto add_parts = [&](const std::string& table, const MachineArea& area) {
        for (const AreaPart& part : area.parts) {
            out += csv_line(csv_cells(table, area.machine.name, json(part), nullptr));
        }
    };
    add_parts("machine", report.machine);
    for (const MachineArea& preset : report.presets) add_parts("preset", preset);
    for (const AreaRow& row : report.rows) {
        out += csv_line(csv_cells("row", report.machine.machine.name, nullptr, json(row)));
    }
    return out;
}

std::string area_html(const AreaReport& report) {
    std::string body = fmt::format("<p class=\"note\">{}</p>\n<p>{}</p>\n", html_escaped(heading(report)),
                                   html_escaped(area_answer(report)));
    for (const AnyChart& chart : area_charts(report)) {
        body += html_figure(draw(chart, ChartFormat::Svg), name_of(chart));
    }
    for (const StudyTable& table : area_tables(report)) {
        body +=
            fmt::format("<h2>{}</h2>\n{}", html_escaped(table.title), html_table(table.columns, table.rows));
        if (!table.note.empty()) body += fmt::format("<p class=\"note\">{}</p>\n", html_escaped(table.note));
    }
    return html_page("Area of the machine", body);
}

}  // namespace rtu::study
