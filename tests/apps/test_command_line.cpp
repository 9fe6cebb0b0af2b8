#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/apps/process.hpp"
#include "tests/model/gltf_builder.hpp"
#include "tests/model/meshes.hpp"
#include "tests/scenes.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAre;
using Json = nlohmann::json;

// Runs the built program in a folder of its own that holds a small scene, ball.glb.
class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        const TriangleMesh mesh = closed_sphere(12, {0, 0, 0}, 1);
        std::vector<std::uint32_t> indices;
        for (const model::Triangle& triangle : mesh.triangles) {
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        }
        GltfBuilder builder;
        const std::size_t positions = builder.add_positions(mesh.positions);
        const std::size_t accessor = builder.add_indices(indices);
        builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", accessor}});
        static_cast<void>(folder_.write("ball.glb", builder.glb()));
    }

    Process start(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), RTUSIM_EXECUTABLE);
        return Process(folder_.path(), arguments);
    }
    ProcessResult run(const std::vector<std::string>& arguments) const { return start(arguments).wait(); }
    // A quick run of the small scene, with more options.
    ProcessResult run_ball(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"run", "ball.glb", "--resolution", "16x16"});
        return run(more);
    }
    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            result.push_back(entry.path().filename());
        }
        return result;
    }
    std::string content(const std::string& name) const { return read_file(folder_.path() / name); }

    // Exit code 1, one line on standard error that holds `text`, nothing on standard output, no new file.
    void expect_bad_input(const std::vector<std::string>& arguments, const std::string& text) const {
        const std::vector<std::string> before = names();
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 1) << result.err;
        EXPECT_THAT(result.err, AllOf(StartsWith("rtusim: "), HasSubstr(text)));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
        EXPECT_THAT(names(), testing::UnorderedElementsAreArray(before));
    }

    TemporaryFolder folder_;
};

Json without_host_times(const std::string& text) {
    Json json = Json::parse(text);
    json.erase("host");
    json["pairing"].erase("seconds");
    json["bvh"].erase("build_seconds");
    return json;
}

TEST_F(CommandLine, HelpAndVersionGoToStandardOutput) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"run", "--help"}, {"config", "--help"}, {"--version"}}) {
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_THAT(result.out, HasSubstr("rtusim"));
        EXPECT_THAT(result.err, IsEmpty());
    }
}

TEST_F(CommandLine, WrongUsageIsExitCodeTwo) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"fly"},
                                                      {"run", "--no-such-option"},
                                                      {"run", "--preset"},
                                                      {"config", "extra"},
                                                      {"run", "--threads", "many"},
                                                      {"config", "--markdown", "--compare"}}) {
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.err, StartsWith("rtusim: "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
    }
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

TEST_F(CommandLine, BadValuesAreNamedInOneLine) {
    expect_bad_input({"run", "ball.glb", "--pairing", "window:1"}, "window:1");
    expect_bad_input({"run", "ball.glb", "--edge-identity", "colour"}, "colour");
    expect_bad_input({"run", "ball.glb", "--workload", "primary,specular"}, "specular");
    expect_bad_input({"run", "ball.glb", "--workload", "primary,primary"}, "twice");
    expect_bad_input({"run", "ball.glb", "--workload", ""}, "workload");
    expect_bad_input({"run", "ball.glb", "--preset", "abacus"}, "abacus");
    expect_bad_input({"run", "ball.glb", "--set", "rtu.wings=2"}, "rtu.wings");
    expect_bad_input({"run", "ball.glb", "--clock-mode", "slow"}, "slow");
    expect_bad_input({"config", "--preset", "abacus"}, "abacus");
    for (const char* resolution :
         {"0x5", "16", "16x", "x16", "16x16x16", "-1x5", "16385x1", "1x99999999999999999999"}) {
        expect_bad_input({"run", "ball.glb", "--resolution", resolution}, resolution);
    }
    for (const char* seed : {"-1", "x", "1.5", "18446744073709551616"}) {
        expect_bad_input({"run", "ball.glb", std::string("--seed=") + seed}, seed);
    }
}

TEST_F(CommandLine, BadFilesAreNamedInOneLine) {
    static_cast<void>(folder_.write("empty.glb", ""));
    static_cast<void>(folder_.write("text.glb", "this is no scene"));
    static_cast<void>(folder_.write("cut.glb", content("ball.glb").substr(0, 500)));
    static_cast<void>(folder_.write("bad.toml", "[ball]\neye = 3\n"));
    for (const char* name : {"missing.glb", "empty.glb", "text.glb", "cut.glb"}) {
        expect_bad_input({"run", name, "--json", "out.json", "--csv", "out.csv", "--image", "out"}, name);
        expect_bad_input({"run", "ball.glb", name, "--resolution", "8x8", "--json", "out.json"}, name);
    }
    expect_bad_input({"run", folder_.path()}, "expected a file");
    expect_bad_input({"run", "ball.glb", "--camera", "missing.toml"}, "missing.toml");
    expect_bad_input({"run", "ball.glb", "--camera", "bad.toml"}, "bad.toml:2");
    expect_bad_input({"run", "ball.glb", "--config", "bad.toml"}, "bad.toml:");
}

TEST_F(CommandLine, BadOutputsAreFoundBeforeTheSimulation) {
    expect_bad_input({"run", "ball.glb", "--json", "no/such/folder.json"}, "no/such/folder.json");
    expect_bad_input({"run", "ball.glb", "--csv", "."}, ".: cannot write");
    expect_bad_input({"run", "ball.glb", "--image", "ball.glb"}, "expected a folder");
    expect_bad_input({"run", "ball.glb", "--json", "ball.glb"}, "would be overwritten");
    expect_bad_input({"run", "ball.glb", "--json", "out", "--csv", "./out"}, "same file");
    expect_bad_input({"run", "ball.glb", "ball.glb", "--image", "out"}, "two scenes are called 'ball'");
}

TEST_F(CommandLine, AFullDiskIsReportedAndLeavesNothing) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    expect_bad_input({"run", "ball.glb", "--resolution", "8x8", "--json", "/dev/full", "--csv", "out.csv"},
                     "/dev/full: cannot write: No space left on device");
}

TEST_F(CommandLine, AnInterruptEndsTheRunAtOnceWithoutAFile) {
    // Minutes of work in verification mode, so that the interrupt always comes before the end.
    Process process =
        start({"run", "--resolution", "1024x1024", "--clock-mode", "verify", "--json", "out.json"});
    const std::string status_file = "/proc/" + std::to_string(process.id()) + "/status";
    const auto catches_interrupt = [&] {
        std::stringstream status(read_file(status_file));
        for (std::string word; status >> word;) {
            if (word != "SigCgt:") continue;
            std::uint64_t mask = 0;
            status >> std::hex >> mask;
            return (mask >> (SIGINT - 1) & 1U) != 0;
        }
        return false;
    };
    while (!catches_interrupt()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // into the work
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(::kill(process.id(), SIGINT), 0);
    const ProcessResult result = process.wait();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
    EXPECT_EQ(result.exit_code, 128 + SIGINT);
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb"));
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
