#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using Json = nlohmann::json;

class StabilityCommand : public CommandLine {
  protected:
    ProcessResult stability(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "stability");
        return run(arguments);
    }
    void expect_bad_input(std::vector<std::string> arguments, const std::string& text) const {
        arguments.insert(arguments.begin(), "stability");
        expect_refusal(arguments, text);
    }
};

TEST_F(StabilityCommand, HelpNamesAllCasesAndMethods) {
    const ProcessResult result = stability({"--help"});
    EXPECT_EQ(result.exit_code, 0);
    for (const char* text :
         {"shared_vertex", "compiler", "woop_top_left", "embree_robust", "Examples:", "--scene"}) {
        EXPECT_THAT(result.out, HasSubstr(text));
    }
    EXPECT_THAT(run({"--help"}).out, HasSubstr("rtusim stability"));
}

TEST_F(StabilityCommand, ShowsACaseByParameterAndSeveralAtAGlance) {
    const ProcessResult one = stability({"--case", "slivers", "--method", "woop,rtu", "--rays", "20"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(one.err, IsEmpty());
    EXPECT_THAT(one.out, AllOf(HasSubstr("Parameter"), HasSubstr("1e-8"), HasSubstr("t ulp")));
    const ProcessResult two =
        stability({"--case", "slivers,mailbox,order", "--method", "woop", "--rays", "20"});
    EXPECT_THAT(two.out, AllOf(HasSubstr("Failures per million rays"), HasSubstr("not applicable"),
                               testing::Not(HasSubstr("Parameter"))));
}

TEST_F(StabilityCommand, WritesTheSameRowsAsJsonAndCsv) {
    const ProcessResult result = stability({"--case", "slivers,shared_vertex", "--method", "woop,embree",
                                            "--rays", "8", "--json", "a.json", "--csv", "a.csv"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = Json::parse(content("a.json"));
    const std::string csv = content("a.csv");
    EXPECT_EQ(std::size_t(std::ranges::count(csv, '\n')), report["rows"].size() + 1);
    std::set<std::string> methods;
    for (const Json& row : report["rows"]) {
        methods.insert(row["method"]);
        EXPECT_GE(row["rays"], 1);
        const bool is_surface = row["case"] == "shared_vertex";
        EXPECT_EQ(row["leaks"].is_number(), is_surface);
        EXPECT_TRUE(row["false_hits"].is_number());
        EXPECT_TRUE(row["self_hits"].is_null());
        EXPECT_THAT(csv, HasSubstr(row["parameter"].get<std::string>()));
        for (const char* key : {"contraction", "aim", "doubles", "parity_errors", "wrong_owners", "t_ulp_p50",
                                "t_ulp_p99", "t_ulp_p999", "t_ulp_max"}) {
            EXPECT_TRUE(row.contains(key)) << key;
        }
    }
    EXPECT_EQ(methods, (std::set<std::string>{"embree", "woop"}));
    EXPECT_EQ(report["rays"], 8);
}

TEST_F(StabilityCommand, IsTheSameOnOneThread) {
    const std::vector<std::string> arguments{"--case", "tiny,fans", "--rays",   "300",
                                             "--json", "-",         "--threads"};
    std::vector<std::string> one = arguments, two = arguments, other = arguments;
    one.emplace_back("1");
    two.emplace_back("2");
    other.insert(other.end(), {"2", "--seed", "2"});
    EXPECT_EQ(stability(one).out, stability(two).out);
    EXPECT_NE(stability(one).out, stability(other).out);
}

TEST_F(StabilityCommand, AsksForASceneOwnTriangles) {
    const ProcessResult result =
        stability({"--scene", "ball.glb", "--method", "rtu,moller_trumbore", "--rays", "500", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = Json::parse(result.out);
    std::uint64_t others = 0;
    for (const Json& row : report["rows"]) {
        EXPECT_EQ(row["case"], "scene");
        EXPECT_EQ(row["parameter"], "ball");
        EXPECT_GE(row["hits"], row["method"] == "rtu" && row["aim"] != "around" ? 100 : 0);
        const std::uint64_t failures = row["failures"];
        if (row["method"] == "rtu") {
            EXPECT_EQ(failures, 0U) << row["aim"];
        } else {
            others += failures;
        }
    }
    EXPECT_GT(others, 100U);
    EXPECT_EQ(report["precision"]["answers"][0]["scene"], "ball");
    EXPECT_EQ(report["precision"]["answers"][0]["rays"], 1000);  // of two workloads
}

TEST_F(StabilityCommand, RefusesWhatItCannotDo) {
    expect_bad_input({"--method", "mt"}, "--method: expected snyder_barr, ");
    expect_bad_input({"--case", "edge"}, "--case: expected ordinary, shared_edge, ");
    expect_bad_input({"--case", "tiny,tiny"}, "--case: 'tiny' is given twice");
    expect_bad_input({"--rays", "0"}, "--rays: expected a number from 1 to 4000000000, got '0'");
    expect_bad_input({"--rays", "4000000001"}, "got '4000000001'");
    expect_bad_input({"--rays", "1e3"}, "got '1e3'");
    expect_bad_input({"--seed", "-1"}, "--seed: expected a number");
    expect_bad_input({"--scene", "missing.glb"}, "missing.glb");
    expect_bad_input({"--json", "no/such/folder.json"}, "folder");
    expect_bad_input({"--json", "x", "--csv", "x"}, "named by two options");
    expect_bad_input({"--scene", "ball.glb", "--csv", "ball.glb"}, "would be overwritten");
}

// Every decision and error of a small run is pinned, for the methods that only + - * / and sqrt can change.
// After a wanted change: RTUSIM_WRITE_GOLDEN=1 build/dev/tests/test_apps --gtest_filter='StabilityCommand.*'.
TEST_F(StabilityCommand, CountsAreUnchanged) {
    const std::string path = std::string(RTUSIM_SOURCE_DIR) + "/tests/apps/golden/stability.csv";
    const ProcessResult result = stability({"--method", "exact,rtu,rtu_traversal", "--case",
                                            "shared_vertex,far_offset,slivers,t_range,reintersect,fans",
                                            "--rays", "64", "--csv", "a.csv"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    if (std::getenv("RTUSIM_WRITE_GOLDEN") != nullptr) std::ofstream(path) << content("a.csv");
    EXPECT_EQ(content("a.csv"), read_file(path));
}

}  // namespace
}  // namespace rtu::test
