#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <csignal>
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

class TraceCommand : public CommandLine {
  protected:
    // Runs a command of `rtusim trace` that must succeed.
    std::string trace(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "trace");
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.err, IsEmpty());
        return result.out;
    }
    void record_ball(const std::string& file, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"record", "ball.glb", file, "--resolution", "16x16"});
        static_cast<void>(trace(more));
    }
    // The report of a replay, but for the name of the file.
    Json replay(const std::string& file, std::vector<std::string> more = {"ball.glb"}) const {
        more.insert(more.begin(), {"replay", file, "--json", "-"});
        Json json = without_host_times(trace(more));
        EXPECT_EQ(json["rays_file"], file);
        json.erase("rays_file");
        return json;
    }
    // What the rays of a file take in the built-in scene.
    Json replay_total(const std::string& file) const {
        return Json::parse(trace({"replay", file, "--json", "-"}))["total"];
    }
    void expect_fault(std::vector<std::string> arguments, const std::string& text) const {
        arguments.insert(arguments.begin(), "trace");
        expect_refusal(arguments, text);
    }
    ProcessResult shell(const std::string& line) const {
        const std::string program = "RTUSIM=" + program_path() + "; ";
        return Process(folder_.path(), {"/bin/bash", "-c", program + line}).wait();
    }
};

const std::vector<std::string> all_workloads{"--workload", "primary,shadow,ao,diffuse,random"};

TEST_F(TraceCommand, EveryHelpTeaches) {
    for (const char* command : {"record", "replay", "info", "verify", "convert"}) {
        EXPECT_THAT(trace({command, "--help"}), HasSubstr(std::string("rtusim trace ") + command));
    }
    EXPECT_THAT(trace({"--help"}), AllOf(HasSubstr("record"), HasSubstr("docs/traces.md")));
    EXPECT_EQ(run({"trace"}).exit_code, 2);
    EXPECT_EQ(run({"trace", "replay"}).exit_code, 2);
    EXPECT_EQ(run({"run", "--rays", "a.rays7", "--seed", "2"}).exit_code, 2);
    EXPECT_EQ(run({"run", "--kind", "any"}).exit_code, 2);
}

TEST_F(TraceCommand, AReplayGivesTheReportOfTheRun) {
    record_ball("a.rtutrace", all_workloads);
    std::vector<std::string> options{"--check", "--json", "-"};
    options.insert(options.end(), all_workloads.begin(), all_workloads.end());
    const Json run_report = without_host_times(run_ball(options).out);
    EXPECT_EQ(Json::diff(run_report, replay("a.rtutrace", {"ball.glb", "--check"})), Json::array());
    Json other =
        without_host_times(run({"run", "ball.glb", "--rays", "a.rtutrace", "--check", "--json", "-"}).out);
    other.erase("rays_file");
    EXPECT_EQ(Json::diff(run_report, other), Json::array());
    EXPECT_THAT(trace({"replay", "a.rtutrace", "ball.glb"}), HasSubstr("Rays     from a.rtutrace"));
}

TEST_F(TraceCommand, AReplayOfTraversalsGivesTheReportOfTheRun) {
    record_ball("a.rtutrace", {"--visits"});
    const Json run_report = without_host_times(run_ball({"--json", "-"}).out);
    EXPECT_EQ(Json::diff(run_report, replay("a.rtutrace")), Json::array());
    const std::vector<std::string> machine{
        "--set",  "rtu.ray_slots=8", "--set", "rtu.stack_entries=1", "--set", "rtu.count=2", "--clock-mode",
        "verify", "--json",          "-"};
    std::vector<std::string> on_machine{"ball.glb"};
    on_machine.insert(on_machine.end(), machine.begin(), machine.end() - 2);
    EXPECT_EQ(Json::diff(without_host_times(run_ball(machine).out), replay("a.rtutrace", on_machine)),
              Json::array());
    expect_fault({"replay", "a.rtutrace", "ball.glb", "--set", "bvh.width=8"}, "another memory image");
    expect_fault({"replay", "a.rtutrace", "ball.glb", "--pairing", "none", "--force"},
                 "another memory image");
    expect_fault({"replay", "a.rtutrace", "ball.glb", "--check"}, "--check needs rays");
}

TEST_F(TraceCommand, AnotherMachineGivesTheSameCounts) {
    record_ball("a.rtutrace", all_workloads);
    const Json here = replay("a.rtutrace");
    const Json there = replay("a.rtutrace", {"ball.glb", "--preset", "cxt", "--set", "bvh.width=4", "--set",
                                             "bvh.max_leaf_pairs=1"});
    for (const char* count : {"ray_count", "hit_count", "box_tests", "node_visits", "pair_tests"}) {
        EXPECT_EQ(here["total"][count], there["total"][count]) << count;
    }
    EXPECT_NE(here["total"]["cycles"], there["total"]["cycles"]);
}

TEST_F(TraceCommand, AnotherSceneIsAnErrorUnlessForced) {
    record_ball("a.rtutrace");
    expect_fault({"replay", "a.rtutrace"}, "recorded on scene 'ball' with hash");
    EXPECT_EQ(replay("a.rtutrace", {"--force"})["scene"]["name"], "builtin");
}

TEST_F(TraceCommand, InfoTellsWhereATraceComesFrom) {
    record_ball("a.rtutrace");
    EXPECT_THAT(trace({"info", "a.rtutrace"}),
                AllOf(HasSubstr("Content   rays"), HasSubstr("Generator rtusim "), HasSubstr("ball, hash"),
                      HasSubstr("16 x 16 pixels, seed 1"), HasSubstr("primary   closest")));
    EXPECT_THAT(trace({"verify", "a.rtutrace"}), HasSubstr("no fault in "));
}

TEST_F(TraceCommand, ConvertsToEveryFormatAndBack) {
    record_ball("a.rtutrace", {"--workload", "primary"});
    const Json report = replay("a.rtutrace");
    for (const char* name : {"a.rays7", "a.rays8", "a.npy", "a.csv", "a.jsonl"}) {
        static_cast<void>(trace({"convert", "a.rtutrace", name}));
        EXPECT_EQ(replay(name)["total"], report["total"]) << name;
        static_cast<void>(trace({"convert", name, "b.rtutrace", "--name", "primary", "--scene", "ball.glb"}));
        EXPECT_EQ(replay("b.rtutrace")["workloads"], report["workloads"]) << name;
    }
    expect_fault({"replay", "b.rtutrace"}, "recorded on scene 'ball'");
    EXPECT_EQ(content("a.rays8"), content("a.npy").substr(128));
}

TEST_F(TraceCommand, ConvertTakesOneWorkloadAndRefusesBadWishes) {
    record_ball("a.rtutrace");
    expect_fault({"convert", "a.rtutrace", "a.npy"}, "expected rays of one workload");
    EXPECT_THAT(trace({"convert", "a.rtutrace", "a.npy", "--workload", "shadow"}),
                HasSubstr("shadow    any"));
    expect_fault({"convert", "a.rtutrace", "b.npy", "--workload", "ao"}, "found none");
    expect_fault({"convert", "a.rtutrace", "a.rtutrace"}, "is an input of this run");
    expect_fault({"convert", "a.rtutrace", "a.tiff"}, "expected a name that ends in");
    expect_fault({"convert", "missing.csv", "b.npy"}, "no such file");
    expect_fault({"convert", "a.npy", "b.rtutrace", "--name", "a b"}, "--name: expected");
    expect_fault({"convert", "a.npy", "b.rtutrace", "--kind", "both"}, "expected closest or any");
    expect_fault({"replay", "a.npy", "ball.glb", "--image", "."}, "--image needs a camera");
    static_cast<void>(folder_.write("empty.jsonl", ""));
    expect_fault({"convert", "empty.jsonl", "b.rtutrace"}, "found none");
    expect_fault({"replay", "empty.jsonl"}, "found none");
}

// The three lines of docs/traces.md.
TEST_F(TraceCommand, NumPyMakesRaysInThreeLines) {
    std::string python;
    for (const char* candidate : {"/usr/bin/python3", "python3"}) {
        if (shell(candidate + std::string(" -c 'import numpy'")).exit_code == 0) python = candidate;
    }
    if (python.empty()) GTEST_SKIP() << "no python3-numpy here";
    const std::string docs = read_file(std::string(RTUSIM_SOURCE_DIR) + "/docs/traces.md");
    const std::string begin = "```python\n";
    const std::size_t at = docs.find(begin);
    ASSERT_NE(at, std::string::npos);
    const std::string code = docs.substr(at + begin.size(), docs.find("```", at + 3) - at - begin.size());
    EXPECT_EQ(std::count(code.begin(), code.end(), '\n'), 3) << code;
    static_cast<void>(folder_.write("make.py", code));
    const ProcessResult made = shell(python + " make.py");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    static_cast<void>(trace({"convert", "rays.npy", "rays.rtutrace"}));
    EXPECT_GT(replay("rays.npy")["total"]["hit_count"], 0);
    EXPECT_EQ(replay("rays.rtutrace")["total"], replay("rays.npy")["total"]);
    // What NumPy makes by default is refused with the way out.
    ASSERT_EQ(shell(python + " -c 'import numpy; numpy.save(\"wide.npy\", numpy.zeros((2, 8)))'").exit_code,
              0);
    expect_fault({"convert", "wide.npy", "wide.rtutrace"}, "rays.astype('<f4'");
    // And the other way round.
    static_cast<void>(trace({"convert", "rays.rtutrace", "back.npy"}));
    EXPECT_EQ(shell(python + " -c 'import numpy as np; a = np.load(\"rays.npy\"); b = np.load(\"back.npy\"); "
                             "exit(0 if a.tobytes() == b.tobytes() and a.shape == b.shape else 1)'")
                  .exit_code,
              0);
}

TEST_F(TraceCommand, AFullDiskLeavesWhatCanBeRecovered) {
    const ProcessResult full = shell("$RTUSIM trace record ball.glb /dev/full --resolution 16x16");
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_THAT(full.err, HasSubstr("/dev/full: byte 0: cannot write: No space left on device"));
    // 40 KiB are enough for some chunks of 65,536 rays, and not for all.
    const ProcessResult limited = shell(
        "trap '' XFSZ; ulimit -f 40; $RTUSIM trace record ball.glb a.rtutrace --workload primary,random "
        "--resolution 512x512");
    EXPECT_EQ(limited.exit_code, 1);
    EXPECT_THAT(limited.err, ContainsRegex("a.rtutrace: byte 40960: cannot write: File too large; "
                                           "a.rtutrace.partial holds what was written before"));
    EXPECT_EQ(std::count(limited.err.begin(), limited.err.end(), '\n'), 1);
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb", "a.rtutrace.partial"));
    expect_fault({"verify", "a.rtutrace.partial"}, "the file ends after");
    expect_fault({"record", "ball.glb", "a.rtutrace"}, "a.rtutrace.partial: is there already");
}

TEST_F(TraceCommand, AnInterruptedRecordingIsRecovered) {
    Process recording = start(
        {"trace", "record", "ball.glb", "a.rtutrace", "--resolution", "8192x8192", "--workload", "random"});
    const auto partial = folder_.path() / "a.rtutrace.partial";
    std::error_code error;
    for (int i = 0; i < 5000 && std::filesystem::file_size(partial, error) + 1 < 2'000'000; ++i)
        ::usleep(1000);
    ::kill(recording.id(), SIGKILL);
    EXPECT_EQ(recording.wait().exit_code, -1);
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb", "a.rtutrace.partial"));
    EXPECT_EQ(run({"trace", "verify", "a.rtutrace.partial"}).exit_code, 1);
    EXPECT_THAT(trace({"verify", "a.rtutrace.partial", "--recover", "a.rtutrace"}),
                HasSubstr("How many rays are missing is not known"));
    EXPECT_THAT(trace({"verify", "a.rtutrace"}), HasSubstr("no fault"));
    EXPECT_THAT(trace({"info", "a.rtutrace"}), AllOf(HasSubstr("recovered"), HasSubstr("ball, hash")));
}

TEST_F(TraceCommand, DamageIsNamedAndTheRestRecovered) {
    record_ball("a.rtutrace");
    std::string bytes = content("a.rtutrace");
    const std::size_t shadow = bytes.find("RtBk", bytes.find("RtBk", bytes.find("RtBk") + 4) + 4);
    bytes[shadow + 60] = char(bytes[shadow + 60] ^ 1);
    static_cast<void>(folder_.write("bad.rtutrace", bytes));
    const std::string where = fmt::format("bad.rtutrace: byte {}: damaged block", shadow);
    expect_fault({"verify", "bad.rtutrace"}, where);
    expect_fault({"replay", "bad.rtutrace", "ball.glb", "--json", "a.json"}, where);
    EXPECT_EQ(run({"trace", "info", "bad.rtutrace"}).exit_code, 1);
    EXPECT_THAT(trace({"verify", "bad.rtutrace", "--recover", "saved.rtutrace"}),
                ContainsRegex("Missing: [0-9]+ of the [0-9]+ rays of 'shadow'"));
    const Json whole = replay("a.rtutrace"), saved = replay("saved.rtutrace");
    ASSERT_EQ(saved["workloads"].size(), 2U);
    EXPECT_EQ(saved["workloads"][0], whole["workloads"][0]);
    EXPECT_EQ(saved["workloads"][1], whole["workloads"][2]);
    static_cast<void>(folder_.write("none.rtutrace", "nothing"));
    expect_fault({"verify", "none.rtutrace", "--recover", "b.rtutrace"}, "at least one whole chunk");
}

// Nine times the rays, but the same memory: their growth alone would take 29 MB, with the hits.
TEST_F(TraceCommand, MemoryDoesNotGrowWithTheTrace) {
    if (sanitized_program() != nullptr) GTEST_SKIP() << "the address sanitizer keeps what is freed";
    const auto peak = [&](const char* resolution) {
        const ProcessResult recorded = run({"trace", "record", "ball.glb", "a.rtutrace", "--workload",
                                            "primary", "--resolution", resolution});
        EXPECT_EQ(recorded.exit_code, 0) << recorded.err;
        return Json::parse(
                   trace({"replay", "a.rtutrace", "ball.glb", "--json", "-"}))["host"]["peak_rss_bytes"]
            .get<double>();
    };
    const double small = peak("256x256"), large = peak("768x768");
    EXPECT_LT(large, small + 10e6);
}

TEST_F(TraceCommand, ReplaysOfRealScenesEqualTheirRuns) {
    for (const char* name : {"bunny.glb", "legocar.glb"}) {
        const auto scene = scene_file(name);
        if (!scene) GTEST_SKIP() << "no real scenes here: set RTUSIM_SCENES to their folder";
        const std::string file = std::filesystem::absolute(*scene);
        const std::vector<std::string> rays{"--resolution", "48x48", "--workload", "primary,shadow,diffuse"};
        const auto with_rays = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.end(), rays.begin(), rays.end());
            return arguments;
        };
        const Json report = without_host_times(run(with_rays({"run", file, "--check", "--json", "-"})).out);
        static_cast<void>(trace(with_rays({"record", file, "rays.rtutrace"})));
        static_cast<void>(trace(with_rays({"record", file, "visits.rtutrace", "--visits"})));
        EXPECT_EQ(Json::diff(report, replay("rays.rtutrace", {file, "--check"})), Json::array()) << name;
        Json visits = replay("visits.rtutrace", {file});
        visits["check"] = report["check"];  // which traversals cannot have
        EXPECT_EQ(Json::diff(report, visits), Json::array()) << name;
        std::filesystem::remove(folder_.path() / "rays.rtutrace");
        std::filesystem::remove(folder_.path() / "visits.rtutrace");
    }
}

// Counts that another simulator's rays give, pinned; see docs/traces.md.
TEST_F(TraceCommand, RaysOfAnotherSimulatorPassTheCheck) {
    const auto scene = scene_file("cornell_dragon.glb"),
               rays = scene_file("cornell_dragon_primary_256.rays7");
    if (!scene || !rays) GTEST_SKIP() << "no real scenes here: set RTUSIM_SCENES to their folder";
    const ProcessResult result = run({"trace", "replay", std::filesystem::absolute(*rays),
                                      std::filesystem::absolute(*scene), "--check", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["total"]["ray_count"], 65536);
    EXPECT_EQ(json["check"]["compared"], 65536);
    EXPECT_EQ(json["check"]["mismatches"], 0);
    EXPECT_EQ(json["check"]["embree_mismatches"], 0);
}

// Runs the commands of traces/samples/README.md and compares what they make with what is there.
TEST_F(TraceCommand, SamplesAreMadeByTheirCommands) {
    const std::filesystem::path samples = std::string(RTUSIM_SOURCE_DIR) + "/traces/samples";
    std::istringstream lines(read_file(samples / "README.md"));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("    rtusim trace ")) continue;
        const ProcessResult result = shell("$RTUSIM" + line.substr(std::string("    rtusim").size()));
        EXPECT_EQ(result.exit_code, 0) << line << ": " << result.err;
    }
    const bool has_same_zstd = std::string(ZSTD_versionString()) == "1.5.4";
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(samples)) {
        const std::string name = entry.path().filename();
        if (name == "README.md") continue;
        ++compared;
        const bool is_compressed = entry.path().extension() == ".rtutrace";
        EXPECT_TRUE((is_compressed && !has_same_zstd) || read_file(entry.path()) == content(name)) << name;
        if (!is_compressed) continue;
        EXPECT_EQ(replay_total(entry.path()), replay_total(name)) << name;
    }
    EXPECT_GE(compared, 6U);
}

}  // namespace
}  // namespace rtu::test
