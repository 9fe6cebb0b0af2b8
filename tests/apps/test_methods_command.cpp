#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class MethodsCommand : public CommandLine {
  protected:
    [[nodiscard]] ProcessResult measure(std::vector<std::string> more) const {
        more.insert(more.begin(), {"methods", "--triangles", "32", "--rays", "8", "--repeats", "2"});
        return run(more);
    }
};

TEST_F(MethodsCommand, HelpNamesEveryMethodAndForm) {
    const ProcessResult result = run({"methods", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("moller_trumbore"), HasSubstr("[HH11]"), HasSubstr("triangles  "),
                                  HasSubstr("Examples:")));
}

TEST_F(MethodsCommand, PrintsTablesAndNothingOnStandardError) {
    const ProcessResult result = measure({"--method", "wald,woop"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, AllOf(HasSubstr("Beside Table I"), HasSubstr("1 ray x 1 pair")));
}

TEST_F(MethodsCommand, MeasuresASceneAndWritesJsonToStandardOutput) {
    const ProcessResult result = measure(
        {"ball.glb", "--workload", "primary", "--form", "single", "--json", "-", "--csv", "rows.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    const auto& rows = report["rows"];
    EXPECT_TRUE(std::ranges::any_of(rows, [](const auto& row) { return row["workload"] == "ball/primary"; }));
    EXPECT_TRUE(std::ranges::all_of(rows, [](const auto& row) { return row["form"] == "single"; }));
    EXPECT_THAT(names(), testing::Contains("rows.csv"));
}

TEST_F(MethodsCommand, RefusesBadInputInOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--method", "wald,foo"}, "got 'foo'"},
        {{"--method", "wald,wald"}, "--method: 'wald' is given twice"},
        {{"--form", "packet"}, "got 'packet'"},
        {{"--triangles", "33"}, "expected an even number, got 33"},
        {{"missing.glb"}, "missing.glb"},
        {{"--csv", "no/such/folder/x.csv"}, "x.csv"},
        {{"ball.glb", "--json", "ball.glb"}, "is an input of this run"},
    };
    for (const auto& [arguments, text] : cases) {
        std::vector<std::string> all{"methods"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        expect_refusal(all, text);
    }
    EXPECT_EQ(run({"methods", "--rays", "0"}).exit_code, 2);
}

}  // namespace
}  // namespace rtu::test
