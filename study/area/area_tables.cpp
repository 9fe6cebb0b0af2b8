#include "study/area/area_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/config_keys.hpp"
#include "study/pairing/pairing_report.hpp"

namespace rtu::study {
namespace {

using Column = TextTable::Column;
using Cells = std::vector<std::string>;
using sim::PairMode;

std::string count(double value) { return grouped(std::uint64_t(std::llround(value))); }
std::string kilobits(double bits) { return bits > 0 ? fixed(bits / 1024, bits < 10240 ? 1 : 0) : "-"; }
std::string change(double before, double after) {
    return before > 0 ? fmt::format("{:+.2f}", *change_percent(before, after)) : "-";
}
std::string_view name_of(PairMode mode) { return sim::pair_mode_names()[std::size_t(mode)]; }

const std::vector<Column> gate_columns{
    {"Gates"}, {"of them\nregisters"}, {"Register\nbits"}, {"Multipliers"}, {"Adders"}, {"Depth\ngates"}};

void add_gates(const GateCounts& gates, Cells& cells) {
    cells.insert(cells.end(),
                 {count(gates.gates), count(gates.register_gates), count(gates.register_bits),
                  count(gates.multipliers), count(gates.adders), gates.depth > 0 ? count(gates.depth) : "-"});
}

StudyTable with_gates(std::string title, std::vector<Column> first, std::vector<Column> last) {
    StudyTable table{.title = std::move(title), .note = "", .columns = std::move(first), .rows = {}};
    table.columns.insert(table.columns.end(), gate_columns.begin(), gate_columns.end());
    table.columns.insert(table.columns.end(), last.begin(), last.end());
    return table;
}

StudyTable box_table() {
    StudyTable table = with_gates("Box unit: a node of W children every W / lanes cycles",
                                  {{"Width"}, {"Lanes"}}, {{"Gates\na lane"}, {"Basis", left_aligned}});
    for (const std::uint32_t width : {2U, 4U, 6U, 8U}) {
        for (std::uint32_t lanes = std::max(1U, width / 2); lanes <= width;
             lanes += std::max(1U, width / 2)) {
            const std::vector<AreaPart> parts = box_area(lanes, width);
            const GateCounts gates = total(parts).gates;
            Cells& cells = table.rows.emplace_back(Cells{count(width), count(lanes)});
            add_gates(gates, cells);
            cells.push_back(count(gates.gates / lanes));
            cells.emplace_back(parts.size() == 1 ? "counted" : "formula");
        }
    }
    table.note = fmt::format(
        "Gates are NAND2 equivalents as {} counts them; a depth is in gates between two registers.",
        gate_counter());
    return table;
}

StudyTable mode_table(const AreaReport& report) {
    StudyTable table =
        with_gates(fmt::format("Pair unit of {} in each mode", report.machine.machine.name),
                   {{"Mode", left_aligned}}, {{"Gates against\ndual_independent, %"}, {"Machine\ngates"}});
    const double independent = report.modes[std::size_t(PairMode::DualIndependent)].pair.gates.gates;
    for (const ModeArea& mode : report.modes) {
        Cells& cells = table.rows.emplace_back(Cells{std::string(name_of(mode.mode))});
        add_gates(mode.pair.gates, cells);
        cells.push_back(change(independent, mode.pair.gates.gates));
        cells.push_back(count(mode.machine_gates));
    }
    return table;
}

StudyTable part_table(const AreaReport& report) {
    const MachineArea& area = report.machine;
    StudyTable table = with_gates(fmt::format("One RTU of {}", area.machine.name),
                                  {{"Unit", left_aligned}, {"Part", left_aligned}, {"Copies"}},
                                  {{"SRAM\nkbit"}, {"Basis", left_aligned}});
    std::string last;
    for (const AreaPart& part : area.parts) {
        Cells& cells =
            table.rows.emplace_back(Cells{part.unit == last ? "" : part.unit, part.name, count(part.copies)});
        last = part.unit;
        add_gates(part.gates(), cells);
        cells.push_back(kilobits(part.sram_bits()));
        cells.push_back(part.how);
    }
    table.rows.emplace_back();
    const AreaTotal sum = area.rtu();
    Cells& cells = table.rows.emplace_back(Cells{"total", "", ""});
    add_gates(sum.gates, cells);
    cells.push_back(kilobits(sum.sram_bits));
    cells.emplace_back("");
    table.note = "SRAM bits are memory cells and in no gate count. A depth of - is not known: a formula.";
    return table;
}

// Of all but the L1's control, which is deeper than the rest and decides on its own clock.
double datapath_depth(const MachineArea& area) {
    double depth = 0;
    for (const char* unit : {"box", "pair", "scheduler", "queues"}) {
        depth = std::max(depth, area.unit(unit).gates.depth);
    }
    return depth;
}

StudyTable preset_table(const AreaReport& report) {
    StudyTable table{
        .title = "Every preset, with the units of the RTL reference in its numbers (thousand gates)",
        .note =
            "ps a gate: what the preset's clock leaves for each gate of the deepest counted path outside the "
            "L1, "
            "with its\nshare of wires and registers. *: a tester without hit units; its exact pass is in no "
            "count.",
        .columns = {{"Preset", left_aligned},
                    {"Box"},
                    {"Pair"},
                    {"Scheduler"},
                    {"Queues"},
                    {"L1\ncontrol"},
                    {"RTU"},
                    {"of them\nregisters"},
                    {"SRAM\nkbit"},
                    {"RTUs"},
                    {"Machine"},
                    {"Clock\nMHz"},
                    {"Depth\ngates"},
                    {"ps\na gate"},
                    {"L1 depth\ngates"}},
        .rows = {}};
    const auto thousands = [](double gates) { return fixed(gates / 1000, 1); };
    for (const MachineArea& area : report.presets) {
        const sim::Config& config = area.machine.config;
        const AreaTotal sum = area.rtu();
        Cells& cells = table.rows.emplace_back(Cells{area.machine.name});
        for (const char* unit : {"box", "pair", "scheduler", "queues", "l1"}) {
            cells.push_back(thousands(area.unit(unit).gates.gates));
        }
        if (config.rtu.pair.hit_units == 0) cells[2] = "*" + cells[2];
        const double depth = datapath_depth(area);
        cells.insert(
            cells.end(),
            {thousands(sum.gates.gates), thousands(sum.gates.register_gates), kilobits(sum.sram_bits),
             count(config.rtu.count), thousands(area.gates()), count(config.clock_mhz), count(depth),
             fixed(ps_per_gate(depth, config.clock_mhz), 1), count(area.unit("l1").gates.depth)});
    }
    return table;
}

StudyTable clock_table(const AreaReport& report) {
    const std::uint32_t clock_mhz = report.machine.machine.config.clock_mhz;
    StudyTable table{
        .title = fmt::format("Depth beside a clock of {} MHz", grouped(clock_mhz)),
        .note = "Two-input gates and multiplexers of the deepest stage, before any sizing or restructuring.",
        .columns = {{"Counted unit", left_aligned}, {"Depth\ngates"}, {"ps\na gate"}},
        .rows = {}};
    for (const CountedUnit& unit : counted_units()) {
        table.rows.push_back(
            {unit.name, count(unit.counts.depth), fixed(ps_per_gate(unit.counts.depth, clock_mhz), 1)});
    }
    return table;
}

StudyTable row_table(const AreaReport& report) {
    StudyTable table{
        .title = fmt::format("What sharing the common edge costs in cycles (MRPS at {} MHz)",
                             grouped(report.machine.machine.config.clock_mhz)),
        .note =
            "Change: dual_shared against dual_independent. Pair unit: what it alone would let through, were "
            "its\n"
            "most used part held all the time. /Mgate: a million gates of the machine, or of the pair unit.",
        .columns = {{"Scene", left_aligned},
                    {"Workload", left_aligned},
                    {"Pairs\nper ray"},
                    {"Replays\n% of pairs"},
                    {"Survivors\n% of pairs"},
                    {"MRPS\nsingle"},
                    {"MRPS\nindependent"},
                    {"MRPS\nshared"},
                    {"MRPS\nchange %"},
                    {"MRPS/Mgate\nsingle"},
                    {"MRPS/Mgate\nindependent"},
                    {"MRPS/Mgate\nshared"},
                    {"MRPS/Mgate\nchange %"},
                    {"Pair unit MRPS\nchange %"},
                    {"its MRPS/Mgate\nchange %"}},
        .rows = {}};
    std::string last;
    for (const AreaRow& row : report.rows) {
        if (row.mode != PairMode::DualShared) continue;
        const AreaRow& single = in_mode(report, row, PairMode::Single);
        const AreaRow& dual = in_mode(report, row, PairMode::DualIndependent);
        if (!last.empty() && row.scene != last) table.rows.emplace_back();
        table.rows.push_back({row.scene == last ? "" : row.scene, row.workload, per(row.pair_tests, row.rays),
                              percent(row.replays, row.pair_tests), percent(row.survivors, row.pair_tests),
                              fixed(single.mrps, 1), fixed(dual.mrps, 1), fixed(row.mrps, 1),
                              change(dual.mrps, row.mrps), fixed(single.mrps_per_mgate, 2),
                              fixed(dual.mrps_per_mgate, 2), fixed(row.mrps_per_mgate, 2),
                              change(dual.mrps_per_mgate, row.mrps_per_mgate),
                              change(dual.pair_limit_mrps, row.pair_limit_mrps),
                              change(dual.pair_limit_mrps_per_mgate, row.pair_limit_mrps_per_mgate)});
        last = row.scene;
    }
    return table;
}

// Of the changes to dual_shared from another mode, in percent.
struct Range {
    double least = INFINITY, most = -INFINITY;
    std::size_t count = 0, positive = 0;
};

Range change_range(const AreaReport& report, PairMode from, double AreaRow::*rate) {
    Range range;
    for (const AreaRow& row : report.rows) {
        if (row.mode != PairMode::DualShared) continue;
        const double more = change_percent(in_mode(report, row, from).*rate, row.*rate).value_or(0);
        range.least = std::min(range.least, more);
        range.most = std::max(range.most, more);
        ++range.count;
        range.positive += more > 0 ? 1 : 0;
    }
    return range;
}

}  // namespace

std::vector<StudyTable> area_tables(const AreaReport& report) {
    std::vector<StudyTable> tables{box_table(), mode_table(report), part_table(report), preset_table(report),
                                   clock_table(report)};
    if (!report.rows.empty()) tables.push_back(row_table(report));
    return tables;
}

std::string area_answer(const AreaReport& report) {
    const ModeArea& dual = report.modes[std::size_t(PairMode::DualIndependent)];
    const ModeArea& shared = report.modes[std::size_t(PairMode::DualShared)];
    const GateCounts &a = dual.pair.gates, &b = shared.pair.gates;
    std::string text = fmt::format(
        "Sharing the common edge saves {} of the {} gates of the pair unit ({:.1f} %), {:.0f} of {:.0f} "
        "multipliers "
        "and {:.0f} of {:.0f} adders, against two independent testers; {:.1f} % of the whole machine.",
        count(a.gates - b.gates), count(a.gates), saved_pair_percent(report), a.multipliers - b.multipliers,
        a.multipliers, a.adders - b.adders, a.adders, saved_machine_percent(report));
    if (report.rows.empty()) return text;
    const Range mrps = change_range(report, PairMode::DualIndependent, &AreaRow::mrps);
    const Range dual_gain = change_range(report, PairMode::DualIndependent, &AreaRow::mrps_per_mgate);
    const Range single_gain = change_range(report, PairMode::Single, &AreaRow::mrps_per_mgate);
    text += fmt::format(
        "\nIt changes MRPS by {:+.2f} to {:+.2f} %, and MRPS per million gates of the machine by {:+.2f} to "
        "{:+.2f} %;"
        "\nagainst one triangle at a time (single) the latter is {:+.2f} to {:+.2f} %, and more in {} of {} "
        "runs.",
        mrps.least, mrps.most, dual_gain.least, dual_gain.most, single_gain.least, single_gain.most,
        single_gain.positive, single_gain.count);
    return text;
}

}  // namespace rtu::study
