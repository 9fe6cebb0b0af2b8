#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "sim/config_keys.hpp"
#include "sim/effective_config.hpp"
#include "sim/presets.hpp"
#include "study/area/area_charts.hpp"
#include "study/area/area_output.hpp"
#include "study/area/area_study.hpp"
#include "study/area/area_tables.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

using sim::PairMode;
using testing::AllOf;
using testing::HasSubstr;

sim::Config config_with(const std::vector<std::string>& sets) {
    return sim::load_config("default", std::nullopt, sets).config;
}

// A formula is within that share of what was counted.
void expect_near(const GateCounts& formula, const GateCounts& counted, double share) {
    EXPECT_NEAR(formula.gates, counted.gates, share * counted.gates);
    EXPECT_NEAR(formula.register_bits, counted.register_bits, share * counted.register_bits);
    EXPECT_NEAR(formula.register_gates, counted.register_gates, share * counted.register_gates);
    EXPECT_EQ(formula.multipliers, counted.multipliers);
    EXPECT_EQ(formula.adders, counted.adders);
}

TEST(GateCounts, AreReadFromTheFileOfTheReference) {
    const auto units = parse_gates_csv(
        "# Yosys 1, "
        "x\nunit,gates,register_bits,register_gates,multipliers,adders,depth\na:W=2,70,3,20,1,2,9\n");
    ASSERT_EQ(units.size(), 1U);
    EXPECT_EQ(units[0].name, "a:W=2");
    EXPECT_EQ(units[0].counts, (GateCounts{70, 3, 20, 1, 2, 9}));
    EXPECT_THROW(static_cast<void>(parse_gates_csv("unit,gates\n")), std::logic_error);
    EXPECT_THROW(
        static_cast<void>(parse_gates_csv(
            "# x\nunit,gates,register_bits,register_gates,multipliers,adders,depth\na,1,2,3,4,5,-6\n")),
        std::logic_error);
    EXPECT_THROW(static_cast<void>(gate_counts("nobody")), std::logic_error);
    EXPECT_GT(gate_counts("fp32_mul").gates, 1000);
    EXPECT_THAT(std::string(gate_counter()), testing::StartsWith("Yosys "));
}

// The formula is made of the testers of 2 and 8 children.
TEST(AreaFormula, OfBoxTestersGivesTheWidthsThatItWasNotMadeFrom) {
    for (const std::uint32_t width : {3U, 4U, 6U}) {
        GateCounts formula = box_common_area();
        formula += times(width, box_lane_area());
        formula += gate_counts(fmt::format("near_to_far:Width={}", width));
        expect_near(formula, gate_counts(fmt::format("box_tester:Width={}", width)), 0.005);
    }
    EXPECT_NEAR(box_lane_area().gates, gate_counts("slab_lane").gates,
                0.005 * gate_counts("slab_lane").gates);
}

TEST(AreaFormula, OfAQueueGivesTheCountedOnes) {
    expect_near(queue_area(8, 7), gate_counts("stream_fifo:Width=7:Depth=8"), 0.03);
    expect_near(queue_area(6, 161), gate_counts("stream_fifo:Width=161:Depth=6"), 0.03);
    expect_near(queue_area(16, 64), gate_counts("stream_fifo:Width=64:Depth=16"), 0.03);
}

TEST(AreaFormula, OfAQueueOfSeveralItemsACycleGivesTheCountedOnes) {
    expect_near(multi_queue_area({4, 46, 2, 2}, true),
                gate_counts("multi_fifo:Width=46:Depth=4:Push=2:Pop=2"), 0.05);
    expect_near(multi_queue_area({8, 267, 1, 2}, true),
                gate_counts("multi_fifo:Width=267:Depth=8:Push=1:Pop=2"), 0.05);
    expect_near(multi_queue_area({16, 60, 3, 2}, true),
                gate_counts("multi_fifo:Width=60:Depth=16:Push=3:Pop=2"), 0.05);
}

// The formula is made of 16 and 128 slots.
TEST(AreaFormula, OfFreeSlotsGivesTheNumberThatItWasNotMadeFrom) {
    const GateCounts& counted = gate_counts("free_slots:Slots=64");
    EXPECT_NEAR(free_slots_area(64).gates, counted.gates, 0.03 * counted.gates);
}

// Parts of the scheduler are made of stacks of 16 entries, the survivors of 8 too.
TEST(AreaFormula, OfStacksGivesTheDepthThatItWasNotMadeFrom) {
    const sim::Config config = config_with({"rtu.stack_entries=12"});
    for (const AreaPart& part : rtu_area(config)) {
        const bool is_step = part.name == "ray step";
        if (!is_step && part.name != "stack survivors") continue;
        const GateCounts& counted =
            gate_counts(is_step ? "ray_step:Width=4:Row=15" : "stack_survivors:Row=15");
        EXPECT_NEAR(part.each.gates, counted.gates, 0.05 * counted.gates) << part.name;
        EXPECT_FALSE(part.is_counted);
    }
}

TEST(AreaModel, TakesWholeBoxTestersWhereTheLanesFit) {
    EXPECT_EQ(total(box_area(4, 4)).gates, gate_counts("box_tester:Width=4"));
    EXPECT_EQ(total(box_area(18, 6)).gates.multipliers, 3 * gate_counts("box_tester:Width=6").multipliers);
    EXPECT_EQ(total(box_area(5, 4)).gates.multipliers, 5 * 6);
    EXPECT_GT(total(box_area(5, 4)).gates.gates, total(box_area(4, 4)).gates.gates);
    EXPECT_LT(total(box_area(4, 8)).gates.gates, 0.6 * total(box_area(8, 8)).gates.gates);
    EXPECT_GT(total(box_area(4, 8)).gates.gates, total(box_area(4, 4)).gates.gates);
}

TEST(AreaModel, CountsBitsOfArraysByTheirFormulas) {
    const MachineArea area = machine_area(
        {"a", config_with({"rtu.ray_slots=16", "rtu.stack_entries=4", "l1.size_bytes=8192", "l1.ways=4"})});
    const auto bits = [&](std::string_view name) {
        for (const AreaPart& part : area.parts) {
            if (part.name == name) return part.sram_bits();
        }
        return -1.0;
    };
    EXPECT_EQ(bits("data"), 8192 * 8);
    // 64 lines: a number of 32 - 7 bits; 4 sectors valid, dirty, on their way; one of 64 MSHRs, one of 4 ages
    EXPECT_EQ(bits("tags, states, ages"), 64 * (25 + 12 + 6 + 2));
    EXPECT_EQ(bits("stacks"), 16 * (4 + 3) * 64);
    // the rays of box unit, pair unit and scheduler; the best hit, three times in parts; two places and 12
    // bits
    EXPECT_EQ(bits("ray slots"), 16 * (355 + 322 + 65 + 224 + 2 * 3 + 12));
    // a line and its way; 16 targets of a slot and its sectors, and how many there are; a place in the free
    // list
    EXPECT_EQ(bits("MSHRs"), 64 * (25 + 2 + 5 + 16 * (4 + 4) + 6));
    // a node of 128 bytes; 7 bits of its parts; a place in each of three queues
    EXPECT_EQ(bits("replies"), 16 * (1024 + 7 + 3 * 4));
}

TEST(AreaModel, HasTheCountedDepthOfTheControlOfTheL1) {
    for (const char* ways : {"4", "16"}) {
        const MachineArea area = machine_area({"", config_with({fmt::format("l1.ways={}", ways)})});
        EXPECT_EQ(area.unit("l1").gates.depth, gate_counts(fmt::format("cache_control:Ways={}", ways)).depth);
    }
}

TEST(AreaModel, GrowsWithEveryResource) {
    const auto area_of = [](const std::vector<std::string>& sets) {
        return machine_area({"", config_with(sets)});
    };
    const MachineArea base = area_of({});
    for (const char* set : {"rtu.box.boxes_per_cycle=8", "rtu.pair.testers=2", "rtu.results_per_cycle=4",
                            "rtu.stack_entries=32", "l1.ways=32", "l1.banks=8"}) {
        EXPECT_GT(area_of({set}).rtu().gates.gates, base.rtu().gates.gates) << set;
    }
    for (const char* set :
         {"rtu.ray_slots=256", "rtu.stack_entries=32", "l1.size_bytes=131072", "l1.mshrs=128"}) {
        EXPECT_GT(area_of({set}).rtu().sram_bits, base.rtu().sram_bits) << set;
    }
    EXPECT_EQ(area_of({"rtu.count=3"}).gates(), 3 * base.gates());
    EXPECT_DOUBLE_EQ(ps_per_gate(40, 1000), 25);
    EXPECT_DOUBLE_EQ(ps_per_gate(0, 1000), 0);
}

// Whatever a sweep may ask for has an area.
TEST(AreaObjective, IsThereForEveryMachine) {
    for (const char* width : {"bvh.width=2", "bvh.width=4", "bvh.width=6", "bvh.width=8"}) {
        for (const char* other : {"rtu.box.boxes_per_cycle=1", "rtu.box.boxes_per_cycle=64",
                                  "rtu.pair.hit_units=0", "rtu.ray_slots=1", "rtu.stack_entries=1",
                                  "l1.ways=1", "l1.banks=32", "rtu.results_per_cycle=1"}) {
            SCOPED_TRACE(fmt::format("{} {}", width, other));
            EXPECT_GT(machine_gates(config_with({width, other})), 1e5);
        }
    }
}

TEST(AreaObjective, IsTheRateOverTheGates) {
    const sim::Config config = config_with({"rtu.count=2", "clock_mhz=500"});
    sim::MachineResult result;
    result.ray_count = 3000;
    result.cycles = 1000;
    const double mgates = 2 * total(rtu_area(config)).gates.gates / 1e6;
    EXPECT_NEAR(mrps_per_mgate(config, result), 3.0 * 500 / mgates, 1e-9);
    result.cycles = 0;
    EXPECT_EQ(mrps_per_mgate(config, result), 0);
}

TEST(AreaModel, LeavesEachGateTheTimeThatTheSourceOfTheClockSays) {
    const sim::EffectiveConfig config = sim::load_config("default", std::nullopt, {});
    const MachineArea area = machine_area({"", config.config});
    double depth = 0;
    for (const char* unit : {"box", "pair", "scheduler", "queues"})
        depth = std::max(depth, area.unit(unit).gates.depth);
    EXPECT_THAT(config.origins[sim::config_key_index("clock_mhz", "")].source,
                AllOf(HasSubstr(fmt::format("{:.1f} ps", ps_per_gate(depth, config.config.clock_mhz))),
                      HasSubstr(fmt::format("the {:.0f} gates", depth))));
}

AreaOptions builtin_area_options() {
    AreaOptions options;
    options.config = config_with({});
    for (const std::string& name : sim::preset_names()) {
        options.presets.push_back({name, sim::load_config(name, std::nullopt, {}).config});
    }
    options.scenes = {SceneSource{}};
    options.workloads = {model::WorkloadKind::Primary, model::WorkloadKind::Shadow};
    options.resolution = {24, 16};
    return options;
}

TEST(AreaStudy, RunsEveryModeOnTheSameRays) {
    const AreaReport report = run_area_study(builtin_area_options());
    ASSERT_EQ(report.rows.size(), 6U);
    for (const AreaRow& row : report.rows) {
        const AreaRow& single = in_mode(report, row, PairMode::Single);
        EXPECT_EQ(row.pair_tests, single.pair_tests);
        EXPECT_EQ(row.triangle_tests, single.triangle_tests);
        EXPECT_GT(row.cycles, 0U);
        EXPECT_NEAR(row.mrps, double(row.rays) / double(row.cycles) * 1000, 1e-9);
        const double mgates = report.modes[std::size_t(row.mode)].machine_gates / 1e6;
        EXPECT_NEAR(row.mrps_per_mgate, row.mrps / mgates, 1e-9);
        EXPECT_GE(row.pair_limit_mrps, row.mrps * 0.999);
        EXPECT_EQ(row.replays, single.replays);  // of hit units, which no build of the first pass changes
    }
    EXPECT_EQ(in_mode(report, report.rows[0], PairMode::Single).tester_cycles, report.rows[0].triangle_tests);
    EXPECT_LT(report.modes[0].machine_gates, report.modes[2].machine_gates);
    EXPECT_LT(report.modes[2].machine_gates, report.modes[1].machine_gates);
    EXPECT_NEAR(saved_pair_percent(report),
                100 * (1 - report.modes[2].pair.gates.gates / report.modes[1].pair.gates.gates), 1e-9);
}

TEST(AreaReport, AddsUpTheWorkloadsOfAScene) {
    AreaReport report;
    for (const double mrps : {100.0, 25.0, 0.0}) {
        AreaRow& row = report.rows.emplace_back();
        row.scene = "hall";
        row.mode = PairMode::Single;
        row.rays = 1000;
        row.mrps = mrps;
    }
    EXPECT_DOUBLE_EQ(scene_rate(report, "hall", PairMode::Single, &AreaRow::mrps), 2000 / (10.0 + 40.0));
    EXPECT_EQ(scene_rate(report, "hall", PairMode::DualShared, &AreaRow::mrps), 0);
    EXPECT_EQ(scene_rate(report, "elsewhere", PairMode::Single, &AreaRow::mrps), 0);
}

TEST(MailboxArea, IsWhatWasCountedAndLinearBetween) {
    const auto with = [](std::uint32_t entries) {
        return total(rtu_area(config_with({fmt::format("rtu.mailbox.entries={}", entries)})));
    };
    const AreaTotal none = with(0);
    const double passing = 2 * gate_counts("held_stack:Width=4:Row=19").gates +
                           gate_counts("multi_fifo:Width=7:Depth=8:Push=2:Pop=2").gates +
                           gate_counts("result_select:Passes=1").gates - gate_counts("result_select").gates;
    for (const std::uint32_t entries : {1U, 2U, 4U, 8U, 16U}) {
        const double counted = gate_counts(fmt::format("mailbox:Entries={}", entries)).gates;
        EXPECT_NEAR(with(entries).gates.gates - none.gates.gates, counted + passing, 1e-6) << entries;
    }
    EXPECT_NEAR(with(6).gates.gates, (with(4).gates.gates + with(8).gates.gates) / 2, 1e-6);
    EXPECT_NEAR(with(4).sram_bits - none.sram_bits, 128 * (4 * 28 + 2 + 1), 1e-6);
}

TEST(MailboxArea, IsWhatThePageSays) {
    std::ifstream stream(std::filesystem::path(RTUSIM_SOURCE_DIR) / "docs/mailbox.md");
    std::map<std::string, std::string> rows;  // by the first cell of a line of a table
    for (std::string line; std::getline(stream, line);) {
        const std::size_t end = line.starts_with("| ") ? line.find(" |") : std::string::npos;
        if (end != std::string::npos) rows[line.substr(2, end - 2)] = line;
    }
    const auto area = [](std::string_view kind, std::uint32_t entries) {
        return total(rtu_area(config_with(
            {fmt::format("rtu.mailbox.kind={}", kind), fmt::format("rtu.mailbox.entries={}", entries)})));
    };
    const AreaTotal none = area("recent", 0);
    const auto check = [&](const std::string& name, const AreaTotal& with) {
        const std::string cells = fmt::format(
            "| {} | {} |", grouped(std::uint64_t(std::lround(with.gates.gates - none.gates.gates))),
            fixed((with.sram_bits - none.sram_bits) / 1024, 1));
        EXPECT_THAT(rows[name], HasSubstr(cells)) << name;
    };
    for (const std::uint32_t entries : {1U, 2U, 4U, 8U, 16U}) {
        check(fmt::format("recent {}", entries), area("recent", entries));
    }
    check("hashed 8", area("hashed", 8));
    check("per_pair", area("per_pair", 0));
}

TEST(AreaReport, SaysTheSameAsTextJsonAndCsv) {
    AreaOptions options = builtin_area_options();
    options.scenes.clear();
    AreaReport report = run_area_study(options);
    EXPECT_TRUE(report.rows.empty());
    for (const auto& [mode, cycles] :
         {std::pair{PairMode::Single, 400}, {PairMode::DualIndependent, 200}, {PairMode::DualShared, 220}}) {
        AreaRow& row = report.rows.emplace_back();
        row.scene = "hall";
        row.workload = "primary";
        row.mode = mode;
        row.rays = 10;
        row.cycles = std::uint64_t(cycles);
        row.mrps = 1e4 / cycles;
        row.mrps_per_mgate = row.mrps / (report.modes[std::size_t(mode)].machine_gates / 1e6);
    }
    const std::string text = area_text(report);
    for (const char* part :
         {"Sharing the common edge saves", "It changes MRPS by -9.09 to -9.09 %", "more in 1 of 1 runs",
          "One RTU of default", "box_tester:Width=4", "pairing_paper", "hall"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    const auto document = nlohmann::json::parse(area_json(report));
    EXPECT_EQ(document["presets"].size(), sim::preset_names().size());
    EXPECT_EQ(document["modes"].size(), 3U);
    EXPECT_EQ(document["rows"][2]["mode"], "dual_shared");
    EXPECT_EQ(document["rows"][2]["cycles"], 220);
    double gates = 0;
    for (const auto& part : document["machine"]["parts"]) gates += double(part["gates"]);
    EXPECT_NEAR(gates, double(document["machine"]["gates"]), 1e-6);
    const std::string csv = area_csv(report);
    EXPECT_THAT(csv, testing::StartsWith("table,machine,unit,part,copies,gates,"));
    EXPECT_THAT(csv, HasSubstr("row,default,,,"));
    ASSERT_EQ(area_charts(report).size(), 4U);
}

}  // namespace
}  // namespace rtu::study
