#include <fmt/format.h>

#include <algorithm>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

struct UnitGates {
    std::string unit;
    double gates = 0, sram_bits = 0;
};

std::vector<UnitGates> unit_gates(const Json& machine) {
    std::vector<UnitGates> units;
    for (const Json& part : machine.at("parts")) {
        const std::string name = text_at(part, "unit");
        auto found = std::ranges::find(units, name, &UnitGates::unit);
        if (found == units.end()) found = units.insert(found, {name});
        found->gates += number_at(part, "gates");
        found->sram_bits += number_at(part, "sram_bits");
    }
    return units;
}

double all_gates(const std::vector<UnitGates>& units) {
    double sum = 0;
    for (const UnitGates& unit : units) sum += unit.gates;
    return sum;
}

PageChart parts_chart(const Json& machine) {
    PageChart chart;
    chart.kind = PageChart::Kind::Stack;
    chart.title = fmt::format("{}: gates of the parts of an RTU", text_at(machine, "name"));
    chart.note = "NAND2 equivalents, without wires and without memories.";
    chart.columns = {{"Part"}, {"Unit"}, {"Gates"}, {"SRAM bits"}, {"Copies"}};
    for (const Json& part : machine.at("parts")) {
        if (number_at(part, "gates") == 0) continue;
        chart.rows.push_back(cells_of(part, {"part", "unit", "gates", "sram_bits", "copies"}));
    }
    chart.group = 1;
    chart.values = {2};
    chart.y_title = "gates";
    return chart;
}

PageChart presets_chart(const Json& json) {
    PageChart chart;
    chart.kind = PageChart::Kind::Stack;
    chart.title = "Gates of an RTU, all presets";
    chart.note = "Each preset is priced with the units of the RTL reference in the preset's numbers.";
    chart.columns = {{"Machine"}};
    std::vector<const Json*> machines{&json.at("machine")};
    for (const Json& preset : json.at("presets")) machines.push_back(&preset);
    for (const UnitGates& unit : unit_gates(*machines.front())) {
        chart.values.push_back(chart.columns.size());
        chart.columns.push_back({unit.unit});
    }
    for (const Json* machine : machines) {
        const bool is_asked = machine == machines.front();
        auto& row = chart.rows.emplace_back(std::vector<PageCell>{
            is_asked ? text_at(*machine, "name") + " (asked for)" : text_at(*machine, "name")});
        const auto units = unit_gates(*machine);
        for (std::size_t i = 1; i < chart.columns.size(); ++i) {
            const auto found = std::ranges::find(units, chart.columns[i].name, &UnitGates::unit);
            row.push_back(cell_of(found == units.end() ? std::nullopt : std::optional(found->gates)));
        }
    }
    chart.y_title = "gates";
    return chart;
}

PageChart modes_chart(const Json& json) {
    PageChart chart;
    chart.title = "Gates by mode of the pair unit";
    chart.note = "The pair unit, and the whole machine with it.";
    chart.columns = {{"Mode"}, {"Pair unit"}, {"Machine"}};
    for (const Json& mode : json.at("modes")) {
        chart.rows.push_back(
            {text_at(mode, "mode"), cell_of(mode.at("pair"), "gates"), cell_of(mode, "machine_gates")});
    }
    chart.values = {1, 2};
    chart.y_title = "gates";
    return chart;
}

PageChart worth_chart(const Json& json) {
    PageChart chart;
    chart.title = "MRPS per million gates";
    chart.note = "What a mode of the pair unit is worth on these scenes.";
    chart.columns = {{"Scene, workload"}, {"Mode"}, {"MRPS per Mgate", 2}, {"MRPS", 2}, {"Cycles"}};
    for (const Json& row : json.at("rows")) {
        chart.rows.push_back({fmt::format("{}, {}", text_at(row, "scene"), text_at(row, "workload")),
                              text_at(row, "mode"), cell_of(row, "mrps_per_mgate"), cell_of(row, "mrps"),
                              cell_of(row, "cycles")});
    }
    chart.group = 1;
    chart.values = {2};
    chart.y_title = "MRPS per million gates";
    return chart;
}

PageFinding size_finding(const Json& machine) {
    const auto units = unit_gates(machine);
    const auto largest = std::ranges::max_element(units, {}, &UnitGates::gates);
    PageFinding found;
    found.subject = text_at(machine, "name");
    if (largest == units.end() || all_gates(units) == 0) return found;
    found.text = fmt::format("An RTU has {:.2f} million gates; the largest unit is {} with {:.0f} %.",
                             all_gates(units) / 1e6, largest->unit, 100 * largest->gates / all_gates(units));
    found.figures = fmt::format("{:.0f} of {:.0f} gates, {:.0f} bits of SRAM beside them", largest->gates,
                                all_gates(units), number_at(machine.at("rtu"), "sram_bits"));
    return found;
}

// Modes by what all rows of them give, as a mean.
std::optional<PageFinding> worth_finding(const Json& json) {
    std::vector<std::pair<std::string, double>> sums;
    for (const Json& row : json.at("rows")) {
        const std::string mode = text_at(row, "mode");
        auto found = std::ranges::find(sums, mode, &std::pair<std::string, double>::first);
        if (found == sums.end()) found = sums.insert(found, {mode, 0});
        found->second += number_at(row, "mrps_per_mgate");
    }
    if (sums.empty()) return std::nullopt;
    const double rows = double(json.at("rows").size()) / double(sums.size());
    const auto best = std::ranges::max_element(sums, {}, &std::pair<std::string, double>::second);
    std::string figures;
    for (const auto& [mode, sum] : sums)
        figures += fmt::format("{}{} {:.2f}", figures.empty() ? "" : ", ", mode, sum / rows);
    return PageFinding{"Pair unit", fmt::format("Mode {} gives most MRPS per gate.", best->first),
                       "Compare with rtu.pair.mode.",
                       figures + " MRPS per million gates, mean over scenes and workloads"};
}

}  // namespace

PageSection area_section(const Json& json) {
    PageSection section;
    section.title = "Area";
    section.note = fmt::format("Gates counted by {} where there is RTL, else by formula.",
                               text_at(json, "gate_counter"));
    section.findings = {size_finding(json.at("machine"))};
    if (auto worth = worth_finding(json)) section.findings.push_back(std::move(*worth));
    section.charts = {parts_chart(json.at("machine")), presets_chart(json), modes_chart(json)};
    if (!json.at("rows").empty()) section.charts.push_back(worth_chart(json));
    return section;
}

}  // namespace rtu::study
