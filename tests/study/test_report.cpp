#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/report/report_csv.hpp"
#include "study/report/report_json.hpp"
#include "study/report/report_text.hpp"
#include "study/text_table.hpp"
#include "tests/study/example_report.hpp"

namespace rtu::study {
namespace {

using test::example_report;
using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
}

std::vector<std::string> lines(const std::string& text, const std::string& end = "\n") {
    std::vector<std::string> result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t stop = text.find(end, begin);
        result.push_back(text.substr(begin, stop - begin));
        begin = stop == std::string::npos ? text.size() : stop + end.size();
    }
    return result;
}

// Splits one CSV line as RFC 4180 says.
std::vector<std::string> csv_cells(const std::string& line) {
    std::vector<std::string> cells{""};
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') {
            if (is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
                cells.back() += line[i++];
            } else {
                is_quoted = !is_quoted;
            }
        } else if (line[i] == ',' && !is_quoted) {
            cells.emplace_back();
        } else {
            cells.back() += line[i];
        }
    }
    return cells;
}

// After a wanted change: RTUSIM_WRITE_GOLDEN=1 build/dev/tests/test_study --gtest_filter='TextReport.*', then
// read the diff.
TEST(TextReport, EqualsTheGoldenFile) {
    const std::string path = std::string(RTUSIM_SOURCE_DIR) + "/tests/study/golden/report.txt";
    SceneReport second = example_report("dragon");
    second.check->mismatches = 1;
    const std::string text = text_report(std::vector{example_report(), second});
    if (std::getenv("RTUSIM_WRITE_GOLDEN") != nullptr) std::ofstream(path) << text;
    std::stringstream golden;
    golden << std::ifstream(path).rdbuf();
    EXPECT_EQ(text, golden.str());
}

TEST(TextReport, FitsInAHundredColumns) {
    SceneReport report = example_report();
    for (WorkloadReport& workload : report.workloads) {  // a long run of a large scene
        workload.ray_count = 16'777'216;
        workload.cycles = 12'345'678'901;
        workload.box_tests = 98'765'432'109;
        for (auto& level : workload.memory) {
            for (auto& counter : level.counters) counter.value *= 1'000'000;
        }
    }
    for (const std::string& line : lines(text_report(std::vector{report, report}))) {
        EXPECT_LE(line.size(), 100U) << line;
        EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
    }
}

TEST(TextReport, LeavesOutACheckThatWasNotAskedForAndShowsAFailedOne) {
    SceneReport report = example_report();
    EXPECT_THAT(text_report(std::vector{report}), HasSubstr("Check: clean"));
    report.check->embree_mismatches = 1;
    EXPECT_THAT(text_report(std::vector{report}), HasSubstr("Check: FAILED"));
    report.check.reset();
    EXPECT_THAT(text_report(std::vector{report}), testing::Not(HasSubstr("Check")));
}

TEST(TextReport, ShowsAFlatMemoryWithoutRows) {
    SceneReport report = example_report();
    for (WorkloadReport& workload : report.workloads) {
        auto& memory = workload.memory.back();
        memory.name = "memory";
        std::erase_if(memory.counters, [](const auto& counter) { return counter.name == "row_hits"; });
    }
    const std::string text = text_report(std::vector{report});
    EXPECT_THAT(text, HasSubstr("\nMemory\n"));
    EXPECT_THAT(text, testing::Not(HasSubstr("DRAM")));
    EXPECT_THAT(text, testing::ContainsRegex("primary +memory +588 +12 +- "));
}

TEST(JsonReport, HasTheDocumentedKeys) {
    const Json json = Json::parse(json_report(std::vector{example_report()}));
    EXPECT_THAT(keys(json["scene"]),
                ElementsAre("name", "triangle_count", "vertex_count", "degenerate_count"));
    EXPECT_THAT(keys(json["pairing"]), ElementsAre("method", "edge_identity", "paired_percent", "pair_count",
                                                   "single_count", "seconds"));
    EXPECT_THAT(keys(json["bvh"]), ElementsAre("width", "node_format", "node_bytes", "node_count",
                                               "leaf_count", "image_bytes", "build_seconds"));
    EXPECT_THAT(keys(json["config"]), ElementsAre("clock_mhz", "rtu.pair.mode"));
    EXPECT_THAT(keys(json["workloads"][0]),
                ElementsAre("name", "ray_count", "hit_count", "box_tests", "node_visits", "pair_tests",
                            "triangle_tests", "cycles", "mrps", "units", "memory"));
    EXPECT_THAT(keys(json["workloads"][0]["units"]), ElementsAre("scheduler", "pair", "l1", "dram"));
    EXPECT_THAT(keys(json["workloads"][0]["units"]["l1"]), ElementsAre("busy", "starved", "blocked", "idle"));
    EXPECT_THAT(keys(json["workloads"][0]["memory"]), ElementsAre("l1", "dram"));
    EXPECT_THAT(keys(json["total"]), ElementsAre("ray_count", "hit_count", "box_tests", "node_visits",
                                                 "pair_tests", "triangle_tests", "cycles", "mrps"));
    EXPECT_THAT(keys(json["host"]),
                testing::IsSupersetOf({"cpu_seconds", "simulated_rays_per_second", "peak_rss_bytes"}));
    EXPECT_THAT(keys(json["check"]),
                testing::IsSupersetOf({"compared", "mismatches", "embree_compared", "embree_mismatches"}));
}

TEST(JsonReport, CarriesTheNumbers) {
    const SceneReport report = example_report();
    const Json json = Json::parse(json_report(std::vector{report}));
    EXPECT_EQ(json["seed"], report.seed);
    EXPECT_EQ(json["scene"]["degenerate_count"], 12);
    EXPECT_EQ(json["config"]["clock_mhz"], 1500);
    EXPECT_EQ(json["config"]["rtu.pair.mode"], "dual_shared");
    EXPECT_EQ(json["camera"]["tan_half_fov"].dump(), "0.4");
    const Json& primary = json["workloads"][0];
    EXPECT_EQ(primary["triangle_tests"], 1983);
    EXPECT_EQ(primary["units"]["scheduler"]["starved"], 2250);
    EXPECT_EQ(primary["units"]["scheduler"]["counters"]["spilled_entries"], 77);
    EXPECT_EQ(primary["memory"]["dram"]["row_hits"], 300);
    EXPECT_DOUBLE_EQ(primary["mrps"], 2048.0 / 9000 * 1500);
    EXPECT_EQ(json["total"]["ray_count"], 2560);
    EXPECT_EQ(json["total"]["cycles"], 13096);
    EXPECT_DOUBLE_EQ(json["total"]["mrps"], 2560.0 / 13096 * 1500);
    EXPECT_DOUBLE_EQ(json["host"]["simulated_rays_per_second"], 2560 / 0.0125);
}

TEST(JsonReport, IsAnArrayForSeveralScenes) {
    const Json json = Json::parse(json_report(std::vector{example_report("a"), example_report("b")}));
    ASSERT_TRUE(json.is_array());
    EXPECT_EQ(json[1]["scene"]["name"], "b");
}

TEST(JsonReport, SaysThatNothingWasComparedWithoutACheck) {
    SceneReport report = example_report();
    report.check.reset();
    EXPECT_EQ(Json::parse(json_report(std::vector{report}))["check"]["compared"], 0);
}

TEST(JsonReport, StaysValidForANameThatIsNotUtf8) {
    const std::string text = json_report(std::vector{example_report("caf\xe9 \"x\"\n")});
    EXPECT_TRUE(Json::accept(text));
}

TEST(CsvReport, HasARowForEachWorkloadAndTheTotal) {
    const auto rows = lines(csv_report(std::vector{example_report("a"), example_report("b")}), "\r\n");
    ASSERT_EQ(rows.size(), 1U + 2 * 3);
    const auto header = csv_cells(rows[0]);
    const auto cell = [&](std::size_t row, const std::string& column) {
        const auto found = std::find(header.begin(), header.end(), column);
        EXPECT_NE(found, header.end()) << column;
        return csv_cells(rows[row])[std::size_t(found - header.begin())];
    };
    for (const std::string& row : rows) EXPECT_EQ(csv_cells(row).size(), header.size());
    EXPECT_EQ(cell(2, "workload"), "shadow");
    EXPECT_EQ(cell(3, "workload"), "total");
    EXPECT_EQ(cell(4, "scene"), "b");
    EXPECT_EQ(cell(1, "triangle_tests"), "1983");
    EXPECT_EQ(cell(1, "scheduler.blocked_cycles"), "1800");
    EXPECT_EQ(cell(1, "dram.row_hits [requests]"), "300");
    EXPECT_EQ(cell(3, "dram.row_hits [requests]"), "");
    EXPECT_EQ(cell(3, "cycles"), "13096");
}

TEST(CsvReport, QuotesWhatWouldBreakARow) {
    const auto rows = lines(csv_report(std::vector{example_report("a,\"b\"")}), "\r\n");
    EXPECT_THAT(rows[1], testing::StartsWith("\"a,\"\"b\"\"\",primary,"));
    EXPECT_EQ(csv_cells(rows[1])[0], "a,\"b\"");
}

TEST(Reports, HostTimesChangeNothingElse) {
    SceneReport slow = example_report();
    slow.host = {1, 2, 2560, 4};
    slow.pairing.seconds = 5;
    slow.bvh.build_seconds = 6;
    const std::vector fast_list{example_report()}, slow_list{slow};
    EXPECT_EQ(csv_report(fast_list), csv_report(slow_list));
    Json fast_json = Json::parse(json_report(fast_list)), slow_json = Json::parse(json_report(slow_list));
    EXPECT_NE(fast_json, slow_json);
    for (Json* json : {&fast_json, &slow_json}) {
        json->erase("host");
        (*json)["pairing"].erase("seconds");
        (*json)["bvh"].erase("build_seconds");
    }
    EXPECT_EQ(fast_json.dump(), slow_json.dump());
}

TEST(Reports, ConfigurationHashChangesWithAnyValue) {
    SceneReport report = example_report();
    const std::string hash = config_hash(report);
    report.config[0].value = std::uint64_t{1501};
    EXPECT_NE(config_hash(report), hash);
}

TEST(Numbers, AreGroupedByThousands) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(18446744073709551615ULL), "18,446,744,073,709,551,615");
    EXPECT_EQ(fixed(1234567.891, 2), "1,234,567.89");
    EXPECT_EQ(fixed(999.999, 2), "1,000.00");
    EXPECT_EQ(fixed(0.5, 0), "0");  // ties to even, as IEEE 754 rounds
}

TEST(Numbers, OfNothingAreADash) {
    EXPECT_EQ(percent(0, 0), "-");
    EXPECT_EQ(percent(1, 3), "33.33");
    EXPECT_EQ(per(5, 0), "-");
    EXPECT_EQ(per(5, 2), "2.50");
}

TEST(Numbers, BytesTakeTheUnitThatFits) {
    EXPECT_EQ(byte_size(0), "0 B");
    EXPECT_EQ(byte_size(1023), "1023 B");
    EXPECT_EQ(byte_size(1024), "1.00 KiB");
    EXPECT_EQ(byte_size(5 * 1024 * 1024 + 512 * 1024), "5.50 MiB");
    EXPECT_EQ(byte_size(3ULL << 30), "3.00 GiB");
}

}  // namespace
}  // namespace rtu::study
