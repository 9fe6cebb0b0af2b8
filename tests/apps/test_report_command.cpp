#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* no_library = "built without its charting library";

class ReportCommand : public CommandLine {
  protected:
    void SetUp() override {
        const ProcessResult result = run({"report", "nobody.json", "--html", "page.html"});
        if (result.err.find(no_library) != std::string::npos) {
            expect_refusal({"report", "nobody.json", "--html", "page.html"}, no_library);
            GTEST_SKIP() << "built without the charting library";
        }
    }
    // Of the page: what its script reads.
    [[nodiscard]] Json page_data(const std::string& name) const {
        const std::string page = content(name);
        const std::string before = "<script type=\"application/json\" id=\"data\">";
        const std::size_t begin = page.find(before) + before.size();
        return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    }
    // Runs a command that writes a result, and the page of that result alone.
    Json page_of(const std::vector<std::string>& command, const std::string& result_file) {
        const ProcessResult made = run(command);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        const ProcessResult result = run({"report", result_file, "--html", "page.html"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return page_data("page.html");
    }
    // A result of that kind, with findings, and charts that all have rows.
    void expect_kind(const std::string& kind, const std::vector<std::string>& command,
                     const std::string& result_file = "result.json") {
        const Json data = page_of(command, result_file);
        EXPECT_EQ(data["sources"][0]["kind"], kind);
        ASSERT_EQ(data["sections"].size(), 1U) << kind;
        const Json& section = data["sections"][0];
        EXPECT_FALSE(section["findings"].empty()) << kind;
        for (const Json& chart : section["charts"]) EXPECT_FALSE(chart["rows"].empty()) << chart["title"];
    }
};

TEST_F(ReportCommand, HelpTeaches) {
    const ProcessResult result = run({"report", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Examples:"), HasSubstr("box_unit.db"), HasSubstr("--html")));
}

TEST_F(ReportCommand, KnowsWhatRunsWrite) {
    expect_kind("run", {"run", "ball.glb", "--resolution", "8x8", "--json", "result.json", "--image", "out"});
    expect_kind("box tests", {"config"}, "out/ball_box_tests.json");
    expect_kind("fidelity", {"run", "ball.glb", "--resolution", "8x8", "--workload", "primary", "--fidelity",
                             "analytic", "--json", "result.json"});
}

TEST_F(ReportCommand, KnowsWhatStudiesOfTheMachineWrite) {
    expect_kind("pairing", {"pairing", "ball.glb", "--resolution", "8x8", "--workload", "primary", "--study",
                            "l1_size,ray_kind", "--json", "result.json"});
    expect_kind("area", {"area", "ball.glb", "--resolution", "8x8", "--workload", "primary", "--json",
                         "result.json"});
    expect_kind("fidelity", {"fidelity", "ball.glb", "--resolution", "8x8", "--workload", "primary",
                             "--preset", "default", "--no-ranking", "--json", "result.json"});
    expect_kind("stream", {"stream", "ball.glb", "--rays", "4", "--pairs", "4", "--json", "result.json"});
}

TEST_F(ReportCommand, KnowsWhatStudiesOfMethodsWrite) {
    expect_kind("stability", {"stability", "--case", "shared_vertex", "--rays", "2", "--method",
                              "wald,woop,rtu", "--json", "result.json"});
    expect_kind("methods",
                {"methods", "--repeats", "1", "--triangles", "16", "--rays", "4", "--json", "result.json"});
    expect_kind("precision",
                {"precision", "ball.glb", "--rays", "20", "--method", "wald", "--json", "result.json"});
}

TEST_F(ReportCommand, KnowsAValidation) {
    const std::vector<std::string> command{"validate", "ball.glb",   "--only",  "base",   "--rays",
                                           "20",       "--workload", "primary", "--json", "result.json"};
    if (run(command).exit_code != 0) GTEST_SKIP() << "built without the RTL";
    expect_kind("validate", command);
}

TEST_F(ReportCommand, KnowsASweepAndItsExport) {
    static_cast<void>(
        folder_.write("s.toml",
                      "scenes = [\"ball.glb\"]\nworkloads = [\"primary\"]\nresolution = [8, 8]\n"
                      "objectives = [\"mrps\", \"min rtu.ray_slots\"]\n[axes]\n"
                      "rtu.ray_slots = [4, 8]\nl1.size_bytes = [8192, 65536]\n"));
    const std::vector<std::string> command{"sweep", "s.toml", "--workers", "1", "--json", "result.json"};
    expect_kind("sweep", command, "s.db");
    const Json database = page_data("page.html")["sections"][0];
    EXPECT_EQ(database["explorer"]["x"], "rtu.ray_slots");
    EXPECT_THAT(std::string(database["note"]), HasSubstr("front of mrps, min rtu.ray_slots"));
    expect_kind("sweep", {"config"}, "result.json");
    const Json exported = page_data("page.html")["sections"][0];
    // The same points, but an export does not know the front.
    const auto numbers = [](const Json& section, const std::string& name) {
        for (const Json& field : section["explorer"]["fields"]) {
            if (field["name"] == name) return field["numbers"];
        }
        return Json();
    };
    EXPECT_EQ(numbers(database, "mrps").size(), 8U);
    EXPECT_EQ(numbers(database, "mrps"), numbers(exported, "mrps"));
    EXPECT_EQ(database["explorer"]["fields"].size(), exported["explorer"]["fields"].size() + 1);
}

TEST_F(ReportCommand, PutsSeveralResultsOnOnePageAlwaysTheSame) {
    ASSERT_EQ(run_ball({"--json", "a.json"}).exit_code, 0);
    ASSERT_EQ(run_ball({"--set", "rtu.box.boxes_per_cycle=1", "--json", "b.json"}).exit_code, 0);
    ASSERT_EQ(run({"area", "--json", "area.json"}).exit_code, 0);
    const ProcessResult result = run({"report", "a.json", "area.json", "b.json", "--html", "one.html"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("area.json: area"), HasSubstr("one.html: ")));
    ASSERT_EQ(run({"report", "a.json", "area.json", "b.json", "--html", "two.html"}).exit_code, 0);
    EXPECT_EQ(content("one.html"), content("two.html"));
    const Json data = page_data("one.html");
    ASSERT_EQ(data["sections"].size(), 2U);
    EXPECT_EQ(data["sections"][0]["charts"][0]["rows"][0][0], "ball (a)");
    EXPECT_EQ(data["sections"][1]["title"], "Area");
}

TEST_F(ReportCommand, RefusesBadInputInOneLine) {
    static_cast<void>(folder_.write("other.json", "{\"a\": 1}"));
    static_cast<void>(folder_.write("half.json", "{\"rows\": ["));
    static_cast<void>(folder_.write("half.db", "SQLite format 3"));
    expect_refusal({"report", "nobody.json", "--html", "page.html"}, "nobody.json: no such file");
    expect_refusal({"report", "other.json", "--html", "page.html"}, "other.json: expected a result");
    expect_refusal({"report", "half.json", "--html", "page.html"}, "half.json: ");
    expect_refusal({"report", "half.db", "--html", "page.html"}, "half.db");
    expect_refusal({"report", "ball.glb", "--html", "page.html"}, "ball.glb: ");
    expect_refusal({"report", "other.json", "--html", "other.json"}, "other.json");
    expect_refusal({"report", "other.json", "--html", "nowhere/page.html"}, "nowhere");
    expect_refusal({"report", "--html", "page.html"}, "RESULT", 2);
    expect_refusal({"report", "other.json"}, "--html", 2);
}

}  // namespace
}  // namespace rtu::test
