#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class PrecisionCommand : public CommandLine {
  protected:
    [[nodiscard]] ProcessResult judge(std::vector<std::string> more) const {
        more.insert(more.begin(),
                    {"precision", "ball.glb", "--method", "woop,woop_top_left", "--rays", "100"});
        return run(more);
    }
};

TEST_F(PrecisionCommand, HelpTeaches) {
    const ProcessResult result = run({"precision", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("woop_top_left"), HasSubstr("Examples:"), HasSubstr("--wrong")));
}

TEST_F(PrecisionCommand, AnswersForAScene) {
    const ProcessResult result = judge({"--wrong", "50000"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out,
                AllOf(HasSubstr("is the cheapest that is exact enough"),
                      HasSubstr("The narrowest format of each method"), HasSubstr("Quantised filters")));
}

TEST_F(PrecisionCommand, WritesJsonAndCsvThatDoNotDependOnThreads) {
    const ProcessResult one = judge({"--threads", "1", "--json", "-", "--csv", "one.csv"});
    const ProcessResult many = judge({"--json", "-", "--csv", "many.csv"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(one.out, many.out);
    EXPECT_EQ(content("one.csv"), content("many.csv"));
    const auto report = nlohmann::json::parse(one.out);
    EXPECT_EQ(report["answers"][0]["scene"], "ball");
    EXPECT_EQ(report["rows"].size(), 3U * 35U);
    for (const auto& filter : report["filters"]) EXPECT_EQ(filter["false_negatives"], 0);
}

TEST_F(PrecisionCommand, RefusesBadInputInOneLine) {
    const auto refuses = [&](const std::vector<std::string>& arguments, int code, const std::string& text) {
        expect_refusal(arguments, text, code);
    };
    refuses({"precision", "ball.glb", "--method", "wood"}, 1, "woop_top_left");
    refuses({"precision", "nobody.glb"}, 1, "nobody.glb");
    refuses({"precision", "ball.glb", "--rays", "0"}, 2, "--rays");
    refuses({"precision", "ball.glb", "--csv", "ball.glb"}, 1, "ball.glb");
    refuses({"chart", "--only", "sped"}, 1, "parity");
    refuses({"chart", "--only", "parity,parity"}, 1, "twice");
    refuses({"chart", "--only", "parity", "--out", "ball.glb"}, 1, "ball.glb");
}

class ChartCommand : public CommandLine {};

TEST_F(ChartCommand, WritesPicturesAndAPage) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
    const ProcessResult result = run({"chart", "--only", "operations,precision", "--scene", "ball.glb",
                                      "--rays", "50", "--out", "pictures", "--html", "page.html"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(content("pictures/methods_precision.png"), StartsWith("\x89PNG"));
    EXPECT_THAT(content("pictures/methods_operations.svg"), HasSubstr("</svg>"));
    EXPECT_THAT(content("page.html"), HasSubstr("Precision ladder of ball"));
    EXPECT_EQ(result.out,
              "pictures/methods_operations.svg, .png: Operations of triangles that are hit, before the last "
              "division\n"
              "pictures/methods_precision.svg, .png: Precision ladder of ball: mantissas of 7 to 23 "
              "bits, 100 rays\npage.html\n");
}

}  // namespace
}  // namespace rtu::test
