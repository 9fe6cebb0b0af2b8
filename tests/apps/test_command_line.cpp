#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/command_line.hpp"
#include "tests/scenes.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::UnorderedElementsAre;
using Json = nlohmann::json;

TEST_F(CommandLine, HelpAndVersionGoToStandardOutput) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"run", "--help"}, {"config", "--help"}, {"--version"}}) {
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_THAT(result.out, HasSubstr("rtusim"));
        EXPECT_THAT(result.err, IsEmpty());
    }
    EXPECT_THAT(run({"config", "--help"}).out, testing::Not(HasSubstr("bunny.glb")));  // examples of its own
}

TEST_F(CommandLine, RunPrintsTheReportAndNothingOnStandardError) {
    const ProcessResult result = run_ball({"--check"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, AllOf(StartsWith("ball\n"), HasSubstr("primary"), HasSubstr("diffuse"),
                                  HasSubstr("MRPS"), HasSubstr("Check: clean")));
}

TEST_F(CommandLine, TheBuiltInSceneNeedsNoFile) {
    const ProcessResult result = run({"run", "--resolution", "8x8", "--workload", "primary", "--json", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);  // nothing but JSON on standard output
    EXPECT_EQ(json["scene"]["name"], "builtin");
    EXPECT_GE(json["scene"]["triangle_count"], 100'000);
    EXPECT_EQ(json["total"]["ray_count"], 64);
}

TEST_F(CommandLine, WritesEveryKindOfOutput) {
    const ProcessResult result = run_ball(
        {"--json", "ball.json", "--csv", "ball.csv", "--image", "pictures/new", "--workload", "ao,random"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb", "ball.json", "ball.csv", "pictures"));
    const Json json = Json::parse(content("ball.json"));
    EXPECT_EQ(json["workloads"][0]["name"], "ao");
    EXPECT_EQ(json["workloads"][1]["name"], "random");
    EXPECT_THAT(content("ball.csv"), AllOf(StartsWith("scene,workload,"), HasSubstr("\r\nball,ao,")));
    for (const char* name : {"pictures/new/ball_normal.png", "pictures/new/ball_box_tests.png"}) {
        EXPECT_THAT(content(name), StartsWith("\x89PNG")) << name;
    }
    const Json pixels = Json::parse(content("pictures/new/ball_box_tests.json"));
    EXPECT_EQ(pixels["scene"], "ball");
    EXPECT_EQ(pixels["box_tests"].size(), 16U * 16U);
}

TEST_F(CommandLine, SeveralScenesGiveAnArrayAndAnOverview) {
    std::filesystem::copy(folder_.path() / "ball.glb", folder_.path() / "copy.glb");
    const ProcessResult result =
        run({"run", "ball.glb", "copy.glb", "--resolution", "8x8", "--json", "both.json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("Overview"));
    const Json json = Json::parse(content("both.json"));
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[1]["scene"]["name"], "copy");
    EXPECT_EQ(json[0]["total"], json[1]["total"]);
    EXPECT_EQ(json[0]["input_hash"], json[1]["input_hash"]);
}

TEST_F(CommandLine, ReportsAreEqualBetweenRunsThreadCountsAndClockModes) {
    const auto report = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--json", "-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return without_host_times(run_ball(arguments).out);
    };
    const Json first = report({});
    EXPECT_EQ(report({}), first);
    EXPECT_EQ(report({"--threads", "1"}), first);
    EXPECT_EQ(report({"--threads", "4"}), first);
    EXPECT_EQ(report({"--clock-mode", "verify"}), first);
    EXPECT_NE(report({"--seed", "2"}), first);
}

// A camera that looks away: the workloads that start at hits have no rays.
TEST_F(CommandLine, WorkloadsWithoutRaysAreReportedWithTheSameColumns) {
    static_cast<void>(
        folder_.write("away.toml", "eye=[0,0,9]\ntarget=[0,0,10]\nup=[0,1,0]\ntan_half_fov=0.2\n"));
    const ProcessResult result =
        run_ball({"--camera", "away.toml", "--workload", "shadow,primary,ao,diffuse", "--check", "--json",
                  "away.json", "--csv", "away.csv", "--image", "."});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(content("away.json"));
    EXPECT_EQ(json["workloads"][0]["ray_count"], 0);
    EXPECT_EQ(json["workloads"][0]["mrps"], 0);
    EXPECT_EQ(json["workloads"][0]["units"]["box"]["busy"], 0);
    EXPECT_EQ(json["workloads"][0]["memory"]["dram"]["reads"], 0);
    EXPECT_EQ(json["workloads"][1]["hit_count"], 0);
    EXPECT_EQ(json["total"]["ray_count"], 256);
    std::istringstream rows(content("away.csv"));
    std::string header;
    std::getline(rows, header);
    for (std::string row; std::getline(rows, row);) {
        EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
    }
}

TEST_F(CommandLine, OptionsReachTheReport) {
    static_cast<void>(
        folder_.write("camera.toml", "eye=[0,0,9]\ntarget=[0,0,0]\nup=[0,1,0]\ntan_half_fov=0.2\n"));
    static_cast<void>(folder_.write("machine.toml", "[rtu]\nray_slots = 32\n"));
    const ProcessResult result =
        run_ball({"--pairing", "window:3", "--edge-identity", "index", "--seed", "77", "--camera",
                  "camera.toml", "--config", "machine.toml", "--set", "clock_mhz=1234", "--set",
                  "rtu.box.boxes_per_cycle=8", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["pairing"]["method"], "window:3");
    EXPECT_EQ(json["pairing"]["edge_identity"], "index");
    EXPECT_EQ(json["seed"], 77);
    EXPECT_EQ(json["resolution"]["width"], 16);
    EXPECT_EQ(json["camera"]["source"], "camera.toml");
    EXPECT_EQ(json["camera"]["eye"], Json({0.0, 0.0, 9.0}));
    EXPECT_EQ(json["config"]["clock_mhz"], 1234);
    EXPECT_EQ(json["config"]["rtu.ray_slots"], 32);
    EXPECT_EQ(json["config"]["rtu.box.boxes_per_cycle"], 8);
    const double rays = json["total"]["ray_count"], cycles = json["total"]["cycles"];
    EXPECT_DOUBLE_EQ(json["total"]["mrps"], rays / cycles * 1234);
}

TEST_F(CommandLine, ConfigPrintsWhatConfigReads) {
    const ProcessResult printed = run({"config", "--set", "rtu.ray_slots=48"});
    EXPECT_EQ(printed.exit_code, 0);
    EXPECT_THAT(printed.out, HasSubstr("ray_slots"));
    static_cast<void>(folder_.write("machine.toml", printed.out));
    const ProcessResult again = run({"config", "--config", "machine.toml", "--markdown"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(again.out, ContainsRegex("ray_slots.*48"));
    EXPECT_THAT(run({"config", "--compare"}).out, HasSubstr("| "));
}

TEST_F(CommandLine, RealScenesPassTheCheck) {
    for (const char* name : {"bunny.glb", "legocar.glb", "cornell_dragon.glb"}) {
        const auto scene = scene_file(name);
        if (!scene) GTEST_SKIP() << "no real scenes here: set RTUSIM_SCENES to their folder";
        const ProcessResult result =
            run({"run", std::filesystem::absolute(*scene), "--resolution", "64x64", "--workload",
                 "primary,shadow,ao,diffuse,random", "--check", "--json", "-"});
        ASSERT_EQ(result.exit_code, 0) << name << result.err;
        const Json check = Json::parse(result.out)["check"];
        EXPECT_GT(check["compared"], 64 * 64);
        EXPECT_EQ(check["compared"], check["embree_compared"]);
        EXPECT_EQ(check["mismatches"], 0) << name;
        EXPECT_EQ(check["embree_mismatches"], 0) << name;
    }
}

}  // namespace
}  // namespace rtu::test
