#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "study/report/loaded_run.hpp"
#include "study/report/page_assets.hpp"
#include "study/report/page_points.hpp"
#include "study/report/page_sections.hpp"
#include "study/report/report_json.hpp"
#include "study/report/report_page.hpp"
#include "tests/model/gltf_builder.hpp"
#include "tests/study/example_report.hpp"

namespace rtu::test {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Json json_of(const study::SceneReport& report) { return Json::parse(study::json_report({{report}})); }

study::PageInput run_input(const std::string& file, const study::SceneReport& report) {
    return {file, "run", {report}, {}};
}

// The data that the page's script reads.
Json page_data(const std::string& page) {
    const std::string_view before = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(before) + before.size();
    return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

class ReportPage : public testing::Test {
  protected:
    void SetUp() override {
        if (study::page_assets().library.empty()) GTEST_SKIP() << "built without the charting library";
    }
};

TEST(LoadedRun, IsTheReportThatWasWritten) {
    const study::SceneReport written = example_report();
    Json before = json_of(written), after = json_of(study::report_of_json(before));
    for (Json* json : {&before, &after}) {
        json->erase("host");
        json->at("pairing").erase("seconds");
        json->at("bvh").erase("build_seconds");
        json->at("camera") = json->at("camera").at("source");
    }
    EXPECT_EQ(before, after);
}

TEST(LoadedRun, GivesTheMachineOfItsKeys) {
    study::SceneReport report = example_report();
    report.config = {{"rtu.box.boxes_per_cycle", std::uint64_t{8}}, {"rtu.pair.mode", std::string("single")}};
    const sim::Config config = study::machine_of(report, "a.json");
    EXPECT_EQ(config.rtu.box.boxes_per_cycle, 8U);
    EXPECT_EQ(config.rtu.pair.mode, sim::PairMode::Single);
    EXPECT_EQ(config.rtu.ray_slots, sim::Config{}.rtu.ray_slots);
    report.config = {{"rtu.box.lanes", std::uint64_t{8}}};
    EXPECT_THROW(static_cast<void>(study::machine_of(report, "a.json")), Error);
    report.config = {{"rtu.box.boxes_per_cycle", std::uint64_t{0}}};
    EXPECT_THROW(static_cast<void>(study::machine_of(report, "a.json")), Error);
}

TEST_F(ReportPage, IsTheSameForTheSameInputs) {
    const std::vector<study::PageInput> inputs{run_input("a.json", example_report()),
                                               run_input("b.json", example_report("dragon"))};
    EXPECT_EQ(study::report_page(inputs), study::report_page(inputs));
}

TEST_F(ReportPage, CarriesEverythingWithIt) {
    const std::string page = study::report_page(std::vector{run_input("a.json", example_report())});
    EXPECT_THAT(page, HasSubstr("Apache License"));
    EXPECT_THAT(page, HasSubstr(std::string(study::page_assets().library.substr(0, 1000))));
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    for (const char* outside : {"<script src", "<link", "<img", "@import", "url("}) {
        const std::string_view own = study::page_assets().library;
        std::string rest = page;
        rest.erase(rest.find(own), own.size());
        EXPECT_THAT(rest, Not(HasSubstr(outside)));
    }
}

TEST_F(ReportPage, NeverTakesANameForMarkup) {
    study::SceneReport report = example_report("</script><script>alert(1)</script><!--");
    const std::string page = study::report_page(std::vector{run_input("<b>.json", report)});
    EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
    EXPECT_THAT(page, Not(HasSubstr("<b>")));
    const Json data = page_data(page);
    EXPECT_EQ(data["sources"][0]["file"], "<b>.json");
    EXPECT_EQ(data["sections"][0]["charts"][0]["rows"][0][0], report.scene.name);
}

TEST_F(ReportPage, TellsRunsOfOneSceneApart) {
    const Json data = page_data(study::report_page(
        std::vector{run_input("a.json", example_report()), run_input("b.json", example_report()),
                    run_input("b.json", example_report()), run_input("c.json", example_report("dragon"))}));
    std::vector<std::string> labels;
    for (const Json& row : data["sections"][0]["charts"][0]["rows"]) {
        if (row[1] == "primary") labels.push_back(row[0]);
    }
    EXPECT_THAT(labels, testing::ElementsAre("bunny (a)", "bunny (b)", "bunny (b) 2", "dragon"));
}

TEST_F(ReportPage, ShowsTheNumbersOfTheRun) {
    const study::SceneReport report = example_report();
    const Json data = page_data(study::report_page(std::vector{run_input("a.json", report)}));
    const Json& charts = data["sections"][0]["charts"];
    const study::WorkloadReport& primary = report.workloads[0];
    EXPECT_NEAR(double(charts[0]["rows"][0][2]), study::mrps(primary.ray_count, primary.cycles, 1500), 1e-2);
    EXPECT_EQ(charts[0]["rows"][0][10], primary.cycles);
    EXPECT_EQ(charts[1]["rows"][0], Json::parse(R"(["primary, scheduler", 50, 25, 20, 5, 9000])"));
    const Json& misses = charts.back();
    EXPECT_EQ(misses["title"], "Cache misses");
    EXPECT_EQ(misses["rows"][0][1], 12);
    EXPECT_EQ(misses["columns"].size(), 2U) << "the example has no L2";
}

TEST(BoxTestsSection, JoinsPixelsUntilTheyAreFewEnough) {
    Json json{{"scene", "a"}, {"width", 300}, {"height", 301}, {"box_tests", Json::array()}};
    for (int i = 0; i < 300 * 301; ++i) json["box_tests"].push_back(i / 300 == 300 ? 7 : i % 2);
    const study::PageSection section = study::box_tests_section(json);
    const study::PageHeatMap& map = section.heat_maps.front();
    EXPECT_EQ(map.pixels, 2U);
    EXPECT_EQ(map.columns, 150U);
    EXPECT_EQ(map.rows, 151U);
    EXPECT_DOUBLE_EQ(map.mean[0], 0.5);
    EXPECT_EQ(map.greatest[0], 1U);
    EXPECT_DOUBLE_EQ(map.mean.back(), 7) << "the last row of cells has one row of pixels";
    json["box_tests"].push_back(0);
    EXPECT_THROW(static_cast<void>(study::box_tests_section(json)), Error);
}

TEST(PointsSection, KeepsWhatVariesAndFindsTheExtremes) {
    study::PagePoints points;
    points.fields = {{"design", {}, false, {}, {"a", "b", "c", "d"}},
                     {"workload", {}, false, {}, {"primary", "total", "total", "total"}},
                     {"rtu.ray_slots", {}, false, {32, 32, 64, 128}, {}},
                     {"clock_mhz", {}, false, {1000, 1000, 1000, 1000}, {}},
                     {"l1.size_bytes", {}, false, {1024, 1024, 2048, 2048}, {}},
                     {"l1_hit_percent", {}, false, {60, 50, 70, 80}, {}},
                     {"slot_cycles", {}, false, {1, 2, 3, 4}, {}},
                     {"mrps", {}, false, {99, 10, 30, 20}, {}}};
    points.objectives = {{"mrps", true}, {"l1.size_bytes", false}};
    const study::PageSection section = study::points_section(points);
    std::vector<std::string> names;
    for (const study::PageField& field : section.explorer->fields) names.push_back(field.name);
    EXPECT_THAT(names, testing::ElementsAre("design", "workload", "rtu.ray_slots", "l1.size_bytes",
                                            "l1_hit_percent", "mrps"));
    EXPECT_EQ(section.explorer->x, "l1.size_bytes");
    EXPECT_EQ(section.explorer->color, "rtu.ray_slots");
    ASSERT_EQ(section.findings.size(), 2U);
    EXPECT_EQ(section.findings[0].text, "30.00 MRPS.");
    EXPECT_THAT(section.findings[0].figures, HasSubstr("rtu.ray_slots = 64"));
    EXPECT_EQ(section.findings[1].text, "10.00 MRPS.");
    ASSERT_EQ(section.charts.size(), 1U);
    ASSERT_EQ(section.charts[0].rows.size(), 1U) << "totals are no rays of their own";
    EXPECT_EQ(std::get<double>(section.charts[0].rows[0][2]), 40);
}

TEST(PageInput, IsOneClearErrorForWhatItIsNot) {
    const TemporaryFolder folder;
    const auto expect_error = [&](const std::string& text, const std::string& said) {
        try {
            static_cast<void>(study::load_page_input(folder.write("it.json", text)));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("it.json: ")) << text;
            EXPECT_THAT(error.what(), HasSubstr(said)) << text;
        }
    };
    expect_error("", "expected a result in JSON");
    expect_error("[1, 2", "line 1");
    expect_error("{}", "got other JSON");
    expect_error("[]", "got other JSON");
    expect_error("7", "got other JSON");
    expect_error(R"({"rows": [{"level": 1}]})", "got other JSON");
    expect_error(R"({"rows": 3})", "it.json");
    expect_error(R"([{"point": 1, "design": 1, "workload": "total", "mrps": 1}, {}])", "key 'point'");
    expect_error(R"({"scene": "a", "width": 2, "height": 2, "box_tests": [1]})", "expected 2 x 2 box tests");
    expect_error(R"({"answers": [1], "filters": [], "rows": []})", "expected a whole result");
    Json run = json_of(example_report());
    run["workloads"][0]["units"]["pair"].erase("counters");
    expect_error(run.dump(), "key 'counters' not found");
    run = json_of(example_report());
    run["config"]["rtu.pair.mode"] = "triple";
    expect_error(run.dump(), "triple");
    EXPECT_THROW(static_cast<void>(study::load_page_input(folder.path() / "nothing.json")), Error);
    EXPECT_THROW(static_cast<void>(study::load_page_input(folder.path())), Error);
}

}  // namespace
}  // namespace rtu::test
