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

class AreaCommand : public CommandLine {};

TEST_F(AreaCommand, HelpTeaches) {
    const ProcessResult result = run({"area", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Examples:"), HasSubstr("builtin"), HasSubstr("--preset")));
}

TEST_F(AreaCommand, CountsTheMachineThatIsAskedFor) {
    const auto gates = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"area", "--json", "-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return double(nlohmann::json::parse(result.out)["machine"]["gates"]);
    };
    EXPECT_GT(gates({"--set", "rtu.box.boxes_per_cycle=8"}), gates({}));
    EXPECT_GT(gates({"--preset", "xe2"}), gates({}));
}

TEST_F(AreaCommand, RunsScenesInEveryMode) {
    const ProcessResult one =
        run({"area", "ball.glb", "--resolution", "8x8", "--threads", "1", "--json", "-", "--csv", "one.csv"});
    const ProcessResult many =
        run({"area", "ball.glb", "--resolution", "8x8", "--json", "-", "--csv", "many.csv"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(one.out, many.out);
    EXPECT_EQ(content("one.csv"), content("many.csv"));
    const auto report = nlohmann::json::parse(one.out);
    ASSERT_EQ(report["rows"].size(), 9U);
    EXPECT_EQ(report["rows"][0]["scene"], "ball");
    EXPECT_EQ(report["rows"][0]["rays"], 64);
}

TEST_F(AreaCommand, WritesPicturesAndAPage) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
    const ProcessResult result = run({"area", "ball.glb", "--resolution", "8x8", "--workload", "primary",
                                      "--charts", "pictures", "--html", "page.html"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(content("pictures/area_machine.png"), StartsWith("\x89PNG"));
    EXPECT_THAT(content("page.html"), HasSubstr("sharing the common edge saves"));
}

TEST_F(AreaCommand, RefusesBadInputInOneLine) {
    const auto refuses = [&](std::vector<std::string> arguments, int code, const std::string& text) {
        arguments.insert(arguments.begin(), "area");
        expect_refusal(arguments, text, code);
    };
    refuses({"nobody.glb"}, 1, "nobody.glb");
    refuses({"ball.glb", "ball.glb"}, 1, "two scenes");
    refuses({"--preset", "nothing"}, 1, "nothing");
    refuses({"--set", "rtu.box.boxes_per_cycle=0"}, 1, "rtu.box.boxes_per_cycle");
    refuses({"ball.glb", "--workload", "sun"}, 1, "sun");
    refuses({"--csv", "x", "--html", "x"}, 1, "two options");
    refuses({"ball.glb", "--html", "ball.glb"}, 1, "ball.glb");
}

}  // namespace
}  // namespace rtu::test
