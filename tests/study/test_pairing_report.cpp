#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/pairing/pairing_json.hpp"
#include "study/pairing/pairing_tables.hpp"
#include "study/pairing/pairing_text.hpp"
#include "tests/study/example_pairing.hpp"

namespace rtu::study {
namespace {

using test::example_pairing_report;
using test::example_pairing_row;
using testing::AllOf;
using testing::DoubleEq;
using testing::HasSubstr;
using testing::Optional;
using Json = nlohmann::ordered_json;

TEST(PairingTable, ChangesAreRelativeToTheOldValue) {
    EXPECT_THAT(change_percent(80, 100), Optional(25.0));
    EXPECT_THAT(change_percent(100, 80), Optional(-20.0));
    EXPECT_THAT(change_percent(0, 0), Optional(0.0));
    EXPECT_EQ(change_percent(0, 1), std::nullopt);
}

TEST(PairingTable, ColumnsAreTheNumbersOfTheRow) {
    PairingRow row = example_pairing_row("bunny");
    // Every change from its own number, so that a swapped one shows.
    row.before.total.box_tests = 1000, row.after.total.box_tests = 990;
    row.before.total.pair_tests = 1000, row.after.total.pair_tests = 980;
    row.before.total.cycles = 1000, row.after.total.cycles = 500;
    row.before.bvh.image_bytes = 1000, row.after.bvh.image_bytes = 970;
    row.before.bvh.build_seconds = 1, row.after.bvh.build_seconds = 0.96;
    row.before.l1_misses = 1000, row.after.l1_misses = 950;
    row.before.l2_misses = 1000, row.after.l2_misses = 940;
    row.before.dram_bytes = 1000, row.after.dram_bytes = 930;
    const auto value = [&row](std::string_view key) { return pairing_column(key).value(row).value(); };
    EXPECT_DOUBLE_EQ(value("seconds"), 1.0);
    EXPECT_DOUBLE_EQ(value("old_paired_percent"), 54.0);
    EXPECT_DOUBLE_EQ(value("new_paired_percent"), 52.0);
    EXPECT_DOUBLE_EQ(value("delta_box_percent"), -1.0);
    EXPECT_DOUBLE_EQ(value("delta_tri_percent"), -2.0);
    EXPECT_DOUBLE_EQ(value("delta_mrps_percent"), 100.0);
    EXPECT_DOUBLE_EQ(value("delta_image_bytes_percent"), -3.0);
    EXPECT_NEAR(value("delta_bvh_build_seconds_percent"), -4.0, 1e-9);
    EXPECT_DOUBLE_EQ(value("delta_l1_misses_percent"), -5.0);
    EXPECT_DOUBLE_EQ(value("delta_l2_misses_percent"), -6.0);
    EXPECT_DOUBLE_EQ(value("delta_dram_bytes_percent"), -7.0);
    EXPECT_THROW((void)pairing_column("delta_beauty_percent"), std::logic_error);
}

TEST(PairingTable, AveragesTheRowsOfOneMethodThatHaveAValue) {
    PairingReport report = example_pairing_report();
    const PairingColumn& column = pairing_column("delta_dram_bytes_percent");
    report.rows[0].after.dram_bytes = 15'000;  // from 20,000: -25 %
    report.rows[2].after.dram_bytes = 25'000;  // +25 %, the same method on the other scene
    report.rows[1].after.dram_bytes = 0;       // another method
    EXPECT_THAT(average(report.rows, "edge_bbsa", column), Optional(DoubleEq(0)));
    report.rows[2].before.dram_bytes = 0;  // no value: the mean of one row
    EXPECT_THAT(average(report.rows, "edge_bbsa", column), Optional(DoubleEq(-25)));
    EXPECT_EQ(average(report.rows, "none", column), std::nullopt);
}

UnitReport unit(const std::string& name, std::vector<CounterValue> counters) {
    return {name, {}, std::move(counters)};
}

// Two workloads of 100 and 300 cycles on two RTUs.
std::vector<WorkloadReport> two_workloads() {
    WorkloadReport workload;
    workload.cycles = 100;
    workload.ray_count = 40;
    workload.units = {unit("rtu0.scheduler", {{"node_fetches", "", 30}, {"leaf_fetches", "", 10}}),
                      unit("rtu0.box", {{"issue_cycles", "", 90}, {"node_visits", "", 120}}),
                      unit("rtu1.box", {{"issue_cycles", "", 50}, {"node_visits", "", 40}}),
                      unit("rtu1.pair", {{"tester_cycles", "", 60}, {"hit_unit_cycles", "", 300}})};
    workload.memory = {
        unit("rtu0.l1", {{"line_reads", "", 80}, {"misses", "", 15}, {"mshr_merges", "", 5}}),
        unit("l2", {{"line_reads", "", 20}, {"misses", "", 12}, {"line_writes", "", 8}}),
        unit("dram", {{"bus_busy_cycles", "", 200}, {"read_bytes", "", 64}, {"write_bytes", "", 32}})};
    WorkloadReport second = workload;
    second.cycles = 300;
    return {workload, second};
}

TEST(PairingRun, UsesAreWorkOverWhatThePartsCanDo) {
    sim::Config config;
    config.rtu.count = 2;
    config.rtu.pair.testers = 3;
    const auto use = [&config](std::string_view part) {
        const auto uses = part_uses(two_workloads(), config);
        return std::ranges::find(uses, part, &PartUse::part)->percent;
    };
    EXPECT_DOUBLE_EQ(use("host"), 100.0 * 80 / (400 * config.host.rays_per_cycle));
    EXPECT_DOUBLE_EQ(use("scheduler"), 100.0 * 80 / (400 * 2 * config.rtu.fetches_per_cycle));
    EXPECT_DOUBLE_EQ(use("box"), 100.0 * 280 / (400 * 2));  // one node a cycle: the cycles that issue
    EXPECT_DOUBLE_EQ(use("pair"), 100.0 * 120 / (400 * 2 * 3));
    EXPECT_DOUBLE_EQ(use("hit"), 100.0 * 600 / (400 * 2 * 3 * config.rtu.pair.hit_units));
    EXPECT_DOUBLE_EQ(use("l1"), 100.0 * 200 / (400 * 2 * config.l1.banks));
    EXPECT_DOUBLE_EQ(use("l2"), 100.0 * 80 / (400 * config.l2.banks));
    EXPECT_DOUBLE_EQ(use("dram"), 100.0 * 400 / (400 * config.dram.channels));
    config.rtu.box.boxes_per_cycle = 2 * config.bvh.width + 1;  // room for two nodes a cycle
    EXPECT_DOUBLE_EQ(use("box"), 100.0 * 160 / (400 * 2));
    EXPECT_EQ(part_uses({}, config).front().percent, 0);  // no cycles
}

TEST(PairingRun, AddsUpWorkloadsAndNamesTheBusiestPart) {
    const PairingRun run = pairing_run({}, {}, two_workloads(), sim::Config{});
    EXPECT_EQ(run.total.cycles, 400U);
    EXPECT_EQ(run.total.ray_count, 80U);
    EXPECT_EQ(run.l1_misses, 30U);
    EXPECT_EQ(run.l2_misses, 24U);
    EXPECT_EQ(run.dram_bytes, 192U);
    EXPECT_DOUBLE_EQ(run.mrps(), 80.0 / 400 * 1000);
    EXPECT_EQ(bound_by(test::example_pairing_run("none", 4)), "box 84 %");
    EXPECT_EQ(bound_by(test::example_pairing_run("none", 2)), "dram 84 %");
}

TEST(PublishedPairing, IsTheTableOfThePaper) {
    EXPECT_EQ(published_rows().size(), 29U);
    const auto row = [](std::string_view scene) { return find_published(scene); };
    EXPECT_EQ(row("dragon")->old_paired_percent, 56.52);
    EXPECT_EQ(row("dragon")->delta_mrps_percent, 17.62);
    EXPECT_EQ(row("bunny")->delta_tri_percent, -34.36);
    EXPECT_EQ(row("conference")->delta_box_percent, -1.73);
    EXPECT_EQ(row("sponza")->delta_mrps_percent, -0.03);
    EXPECT_EQ(row("hairball")->seconds, std::nullopt);
    EXPECT_EQ(row("kitchen"), nullptr);
    // What the paper says of its table: "On average, we observed 7-8 % increase in ray tracing performance".
    double mrps = 0;
    for (const PublishedRow& published : published_rows()) mrps += published.delta_mrps_percent;
    EXPECT_NEAR(mrps / double(published_rows().size()), 7.5, 0.5);
}

TEST(PublishedPairing, IsMarkedWhereTheMeshIsAnotherEdition) {
    EXPECT_TRUE(mesh_identity("bunny", 69'630).is_papers_mesh);
    EXPECT_FALSE(mesh_identity("bunny", 69'451).is_papers_mesh);
    EXPECT_FALSE(mesh_identity("sponza", 279'163).is_papers_mesh);
    PairingReport report = example_pairing_report();
    EXPECT_THAT(pairing_text(report), testing::Not(HasSubstr("(another edition)")));
    report.rows.front().mesh = mesh_identity("bunny", 5);
    EXPECT_THAT(pairing_text(report), HasSubstr("(another edition)"));
    report.rows.front().published = nullptr;
    EXPECT_THAT(pairing_text(report), testing::Not(HasSubstr("Published")));
}

std::vector<std::string> keys_of(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
}

TEST(PairingJson, HasTheDocumentedKeys) {
    const Json json = Json::parse(pairing_json(example_pairing_report()));
    const std::vector<std::string> columns{"seconds",
                                           "old_paired_percent",
                                           "new_paired_percent",
                                           "delta_box_percent",
                                           "delta_tri_percent",
                                           "delta_mrps_percent",
                                           "delta_image_bytes_percent",
                                           "delta_bvh_build_seconds_percent",
                                           "delta_l1_misses_percent",
                                           "delta_l2_misses_percent",
                                           "delta_dram_bytes_percent"};
    ASSERT_EQ(json["rows"].size(), 4U);
    std::vector<std::string> row_keys{"scene", "method", "baseline"};
    row_keys.insert(row_keys.end(), columns.begin(), columns.end());
    row_keys.insert(row_keys.end(), {"old", "new", "published", "compression"});
    EXPECT_EQ(keys_of(json["rows"][0]), row_keys);
    EXPECT_THAT(keys_of(json["average"]), testing::IsSupersetOf(columns));
    EXPECT_EQ(json["average"]["method"], "edge_bbsa");
    EXPECT_EQ(json["averages"].size(), 2U);
    EXPECT_EQ(json["rows"][0]["delta_mrps_percent"], 100.0);
    EXPECT_EQ(json["rows"][0]["old"]["bound_by"], "box");
    EXPECT_EQ(json["rows"][0]["new"]["use_percent"]["dram"], 83.5);
    EXPECT_EQ(json["rows"][0]["published"]["is_papers_mesh"], true);
    EXPECT_TRUE(json["rows"][1]["published"].is_null());
    ASSERT_EQ(json["studies"].size(), pairing_studies().size());
    EXPECT_EQ(json["studies"][0]["name"], "window");
    EXPECT_EQ(json["studies"][0]["rows"][1]["x"], 4.0);
    EXPECT_TRUE(json["studies"][0]["rows"][4]["x"].is_null());
}

/// With the first row's compression, a different number in every place.
PairingReport compressed_report() {
    PairingReport report = example_pairing_report();
    report.rows[0].compression = model::CompressionCost{7'600, 7'700, 120, 30, 3'200, 3'155};
    return report;
}

TEST(PairingReport, SaysWhatCompressionCostsInEveryFormat) {
    const Json rows = Json::parse(pairing_json(compressed_report()))["rows"];
    EXPECT_EQ(rows[0]["compression"].dump(),
              R"({"exact_candidates":7600,"candidates":7700,"wrong_candidates":120,"lost_candidates":30,)"
              R"("exact_pairs":3200,"pairs":3155})");
    EXPECT_TRUE(rows[1]["compression"].is_null());

    std::istringstream csv(pairing_csv(compressed_report()));
    std::string header, first, second;
    std::getline(csv, header);
    std::getline(csv, first);
    std::getline(csv, second);
    EXPECT_THAT(header, testing::EndsWith(",compression_exact_candidates,compression_candidates,"
                                          "compression_wrong_candidates,compression_lost_candidates,"
                                          "compression_exact_pairs,compression_pairs\r"));
    EXPECT_THAT(first, testing::EndsWith(",7600,7700,120,30,3200,3155\r"));
    EXPECT_THAT(second, testing::EndsWith(",,,,,,\r"));

    EXPECT_THAT(pairing_text(compressed_report()),
                testing::ContainsRegex("bunny +7,600 +7,700 +120 +30 +3,200 +3,155 +-45\n"));
    EXPECT_THAT(pairing_text(example_pairing_report()), testing::Not(HasSubstr("compressed")));
    PairingReport without_charts = compressed_report();
    without_charts.studies.clear();
    const auto tables = comparison_tables(without_charts);  // what the page shows
    EXPECT_TRUE(std::ranges::any_of(
        tables, [](const PairingTable& table) { return table.title.starts_with("What 16-byte"); }));
}

TEST(PairingJson, SaysNullForAChangeFromNothing) {
    PairingReport report = example_pairing_report();
    report.rows[0].before.dram_bytes = 0;
    EXPECT_TRUE(Json::parse(pairing_json(report))["rows"][0]["delta_dram_bytes_percent"].is_null());
    EXPECT_THAT(pairing_text(report), HasSubstr(" -\n"));
}

TEST(PairingCsv, HasARowForEachComparisonAndNoHostTime) {
    const std::string csv = pairing_csv(example_pairing_report());
    std::istringstream lines(csv);
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) rows.push_back(line);
    EXPECT_EQ(rows.size(), 1 + 4 + 4 * pairing_studies().size() + 1);
    for (const std::string& row : rows) {
        EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(rows[0], ',')) << row;
    }
    EXPECT_THAT(rows[0], testing::Not(HasSubstr("seconds")));
    EXPECT_THAT(rows[1], testing::StartsWith(",,,bunny,edge_bbsa,window:2,54,52,-50,-50,100,"));
    EXPECT_THAT(rows[5], testing::StartsWith("window,at 2,2,bunny,"));
}

TEST(PairingText, ShowsTablesStudiesAndTheWayTheSceneIsTurned) {
    PairingReport report = example_pairing_report();
    const std::string text = pairing_text(report);
    EXPECT_THAT(text, AllOf(HasSubstr("Pairing impact against window:2"), HasSubstr("average  window:4"),
                            HasSubstr("Study dram_bandwidth"), HasSubstr("+100.00"), HasSubstr("dram 84 %")));
    EXPECT_THAT(text, testing::Not(HasSubstr("turned by")));
    report.rotation = {0, 22.5, 0};
    EXPECT_THAT(pairing_text(report), HasSubstr("turned by 0, 22.5, 0 degrees"));
}

TEST(PairingText, FitsTheColumnsThatItPromises) {
    std::istringstream lines(pairing_text(example_pairing_report()));
    std::size_t longest = 100;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("Study")) longest = 120;
        EXPECT_LE(line.size(), longest) << line;
    }
}

TEST(PairingText, HasNoMinusZero) {
    const PairingColumn& column = pairing_column("delta_box_percent");
    EXPECT_EQ(pairing_cell(column, -0.001), "+0.00");
    EXPECT_EQ(pairing_cell(column, -0.006), "-0.01");
    EXPECT_EQ(pairing_cell(pairing_column("seconds"), 0.0125), "0.013");
}

}  // namespace
}  // namespace rtu::study
