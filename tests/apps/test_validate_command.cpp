#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"
#include "tests/apps/vcd_file.hpp"

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
        run({"validate", "--only", "base,slots_4,single,stack_2,tiny_cache,bandwidth_4", "--rays", "120",
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
    EXPECT_GT(report["summary"]["without_side_tests"], 0);
    EXPECT_EQ(report["summary"]["exact_without_side_tests"], report["summary"]["without_side_tests"]);
}

class Waves : public ValidateCommand {
  protected:
    ProcessResult record(const std::string& file, const std::string& window,
                         const std::string& machine = "base") const {
        return run({"validate", "ball.glb", "--only", machine, "--workload", "primary", "--rays", "30",
                    "--waves", file, "--window", window});
    }
};

// A cycle's signals at twice its number, after its clock edge one later.
TEST_F(Waves, HoldTheWindowThatIsAskedFor) {
    const ProcessResult result = record("rtu.vcd", "100:200");
    if (is_without_rtl(result)) GTEST_SKIP() << result.err;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::uint64_t wrong_clocks = 0;
    const Vcd vcd = read_vcd(content("rtu.vcd"), [&](std::uint64_t time, const auto& values) {
        wrong_clocks += values.at("rtu.clk_i") == std::to_string(time % 2) ? 0 : 1;
    });
    ASSERT_EQ(vcd.times.size(), 200U);
    EXPECT_EQ(vcd.times.front(), 200U);
    EXPECT_EQ(vcd.times.back(), 399U);
    EXPECT_EQ(wrong_clocks, 0U);
    EXPECT_THAT(vcd.signals, testing::IsSupersetOf({"rtu.hit_valid_o", "rtu.rtu.u_core.u_scheduler.ends",
                                                    "rtu.rtu.u_cache.u_control.request_valid_i"}));
    EXPECT_THAT(names(), testing::UnorderedElementsAre("ball.glb", "rtu.vcd"));
}

// A file beside it that has a name in FST's way stays what it is, and so does an earlier recording when there
// is no new one.
TEST_F(Waves, OverwriteNothingElse) {
    const auto write = [&](const char* name) { std::ofstream(folder_.path() / name) << "mine"; };
    for (const char* const name : {"rtu.vcd.fst", "rtu.vcd.hier", "old.fst"}) write(name);
    const ProcessResult result = record("rtu.vcd", "100:101");
    if (is_without_rtl(result)) GTEST_SKIP() << result.err;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(record("old.fst", "900000:900001").exit_code, 1);
    for (const char* const name : {"rtu.vcd.fst", "rtu.vcd.hier", "old.fst"})
        EXPECT_EQ(content(name), "mine");
    EXPECT_THAT(names(), testing::UnorderedElementsAre("ball.glb", "rtu.vcd", "rtu.vcd.fst", "rtu.vcd.hier",
                                                       "old.fst"));
}

// Every ray comes back once, as a reader of its own sees it.
TEST_F(Waves, ShowEveryHitInAnFstFile) {
    const ProcessResult result = record("rtu.fst", "0:1000000");
    if (is_without_rtl(result)) GTEST_SKIP() << result.err;
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const char* reader = "/usr/bin/fst2vcd";
    if (!std::filesystem::exists(reader)) GTEST_SKIP() << "no fst2vcd here (package gtkwave)";
    const ProcessResult read = Process(folder_.path(), {reader, "-f", "rtu.fst"}).wait();
    ASSERT_EQ(read.exit_code, 0) << read.err;
    std::uint64_t hits = 0;
    static_cast<void>(read_vcd(read.out, [&](std::uint64_t time, const auto& values) {
        if (time % 2 == 0) hits += std::size_t(std::ranges::count(values.at("rtu.hit_valid_o"), '1'));
    }));
    EXPECT_EQ(hits, 30U);
}

TEST_F(Waves, AreRefusedInOneLineWhereThereAreNone) {
    const ProcessResult late = record("rtu.vcd", "900000:900001");
    if (is_without_rtl(late)) GTEST_SKIP() << late.err;
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_THAT(late.err, HasSubstr("rtu.vcd: nothing to record from cycle 900000 on: the run ended after "));
    const ProcessResult other = record("rtu.fst", "0:10", "single");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.err, HasSubstr("waves are those of an RTU of width 4 and pair mode 2, got 4 and 0"));
    EXPECT_THAT(names(), testing::ElementsAre("ball.glb"));
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
    refuses({"ball.glb", "--sim-set", "bvh.width=2"}, "the same tree");
    refuses({"ball.glb", "--sim-set", "rtu.nothing=2"}, "rtu.nothing");
    refuses({"ball.glb", "--only", "base", "--workload", "primary", "--waves", "a.png"}, ".fst or .vcd");
    refuses({"ball.glb", "--only", "base", "--workload", "primary", "--waves", "a.fst", "--window", "9:3"},
            "--window");
}

}  // namespace
}  // namespace rtu::test
