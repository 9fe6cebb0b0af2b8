#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ValidateCommand : public CommandLine {
  protected:
    /// True when this program has no RTL reference; the command must then say so in one line.
    static bool is_without_rtl(const ProcessResult& result) {
        return result.exit_code == 1 && result.err.find("without the RTL reference") != std::string::npos &&
               std::ranges::count(result.err, '\n') == 1;
    }
};

TEST_F(ValidateCommand, HelpListsTheMachines) {
    const ProcessResult result = run({"validate", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Examples:"), HasSubstr("stack_2"), HasSubstr("--waves")));
}

// The rays of the built-in scene, on machines that differ in what limits them.
TEST_F(ValidateCommand, FindsHitsAndCountsEqualAndCyclesClose) {
    const ProcessResult result =
        run({"validate", "--only", "base,slots_4,single,stack_2,tiny_cache,bandwidth_4", "--rays", "300",
             "--workload", "primary,shadow", "--json", "-"});
    if (is_without_rtl(result)) GTEST_SKIP() << result.err;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_TRUE(report["difference"].is_null());
    ASSERT_EQ(report["rows"].size(), 12U);
    for (const auto& row : report["rows"]) {
        EXPECT_LE(std::abs(double(row["error_percent"])), 2) << row;
        EXPECT_GT(row["hits"], 0) << row;
    }
    EXPECT_LE(double(report["summary"]["median_percent"]), 0.5);
}

TEST_F(ValidateCommand, RecordsWaves) {
    const ProcessResult result = run({"validate", "ball.glb", "--only", "base", "--workload", "primary",
                                      "--rays", "30", "--waves", "rtu.vcd", "--window", "100:200"});
    if (is_without_rtl(result)) GTEST_SKIP() << result.err;
    if (result.exit_code == 1) GTEST_SKIP() << result.err;  // waves were left out of the build
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(content("rtu.vcd"), HasSubstr("$enddefinitions"));
}

TEST_F(ValidateCommand, RefusesBadInputInOneLine) {
    const auto refuses = [&](std::vector<std::string> arguments, const std::string& text) {
        arguments.insert(arguments.begin(), "validate");
        expect_refusal(arguments, text);
    };
    refuses({"nobody.glb"}, "nobody.glb");
    refuses({"ball.glb", "--only", "bose"}, "bose");
    refuses({"ball.glb", "--only", "base,base"}, "twice");
    refuses({"ball.glb", "--workload", "sun"}, "sun");
    refuses({"ball.glb", "ball.glb"}, "two scenes");
    refuses({"ball.glb", "--waves", "a.fst"}, "one scene");
    refuses({"ball.glb", "--only", "base", "--workload", "primary", "--waves", "a.png"}, ".fst or .vcd");
    refuses({"ball.glb", "--only", "base", "--workload", "primary", "--waves", "a.fst", "--window", "9:3"},
            "--window");
}

}  // namespace
}  // namespace rtu::test
