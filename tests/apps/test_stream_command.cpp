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

class StreamCommand : public CommandLine {
  protected:
    [[nodiscard]] ProcessResult stream(std::vector<std::string> more) const {
        more.insert(more.begin(), {"stream", "ball.glb", "--rays", "16", "--pairs", "20"});
        return run(more);
    }
};

TEST_F(StreamCommand, HelpTeaches) {
    const ProcessResult result = run({"stream", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Modes:"), HasSubstr("Examples:"), HasSubstr("pcie5_x16")));
}

TEST_F(StreamCommand, TellsTheBestOfEveryModeAndLink) {
    const ProcessResult result = stream({});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, AllOf(HasSubstr("16 primary rays, each against 20 pairs"), HasSubstr("resident"),
                                  HasSubstr("on_chip"), HasSubstr("Rate by batch size, batched")));
    for (std::size_t begin = 0; begin < result.out.size();) {
        const std::size_t end = result.out.find('\n', begin);
        EXPECT_LE(end - begin, 100U) << result.out.substr(begin, end - begin);
        begin = end + 1;
    }
}

TEST_F(StreamCommand, WritesJsonAndCsvThatAreTheSameEveryTime) {
    const std::vector<std::string> options{"--mode", "mixed,resident", "--link", "agp_8x,none", "--batch",
                                           "64,16",  "--json",         "-",      "--csv",       "a.csv"};
    const ProcessResult one = stream(options);
    EXPECT_EQ(one.exit_code, 0) << one.err;
    const std::string csv = content("a.csv");
    EXPECT_EQ(stream(options).out, one.out);
    EXPECT_EQ(content("a.csv"), csv);
    const auto report = nlohmann::json::parse(one.out);
    EXPECT_EQ(report["scene"], "ball");
    EXPECT_EQ(report["ray_count"], 16);
    for (const auto& row : report["rows"]) EXPECT_EQ(row["pair_tests"], 16 * 20);
    EXPECT_EQ(report["balances"].size(), 4U);
}

TEST_F(StreamCommand, RefusesBadInputInOneLine) {
    const auto refuses = [&](std::vector<std::string> more, int code, const std::string& text) {
        more.insert(more.begin(), {"stream", "ball.glb"});
        expect_refusal(more, text, code);
    };
    refuses({"--mode", "bulk"}, 1, "mode: expected one of direct, batched, mixed, resident, got 'bulk'");
    refuses({"--mode", "mixed,mixed"}, 1, "'mixed' is given twice");
    refuses({"--link", "pcie9"}, 1, "link: expected one of none, agp_8x");
    refuses({"--batch", "0"}, 1, "--batch: expected numbers of tests from 1");
    refuses({"--batch", "12,x"}, 1, "got 'x'");
    refuses({"--read-back", "all"}, 1, "read-back: expected one of tests, rays, none");
    refuses({"--read-back", "rays"}, 1, "--read-back rays: expected --mode mixed or resident, got direct");
    refuses({"--rays", "1000000", "--pairs", "1000000"}, 1, "expected at most 1073741824 tests");
    refuses({"--set", "link.wires=3"}, 1, "link.wires: expected a number from 1 to 2");
    refuses({"--workload", "primary,shadow"}, 1, "primary,shadow");
    refuses({"--csv", "ball.glb"}, 1, "is an input of this run");
    refuses({"--csv", "nowhere/a.csv"}, 1, "nowhere");
    refuses({"--mode", ""}, 2, "--mode");
    refuses({"--rays", "0"}, 2, "--rays");
}

TEST_F(StreamCommand, RunsOverALinkGiveTheSameHitsAndAnAccountOfTheLink) {
    const auto report = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--check", "--json", "-"});
        const ProcessResult result = run_ball(more);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out);
    };
    const auto alone = report({}), none = report({"--link", "none"});
    const auto linked = report({"--link", "agp_8x", "--set", "link.batch_rays=100"});
    EXPECT_EQ(alone["total"], none["total"]);
    EXPECT_EQ(alone["config_hash"], none["config_hash"]);
    EXPECT_FALSE(alone["workloads"][0]["units"].contains("link"));
    for (const char* count : {"ray_count", "hit_count", "box_tests", "pair_tests"})
        EXPECT_EQ(alone["total"][count], linked["total"][count]) << count;
    EXPECT_GT(linked["total"]["cycles"], alone["total"]["cycles"]);
    const auto& counters = linked["workloads"][0]["units"]["link"]["counters"];
    EXPECT_EQ(counters["up_bytes"], 256 * 32);
    EXPECT_EQ(counters["down_bytes_arrived"], 256 * 16);
    EXPECT_EQ(counters["up_transfers"], 3);
}

}  // namespace
}  // namespace rtu::test
