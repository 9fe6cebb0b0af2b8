#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::UnorderedElementsAre;

class CommandLineErrors : public CommandLine {
  protected:
    // Runs a line of shell in which $RTUSIM is the program and $RUN a quick run of the small scene.
    ProcessResult run_shell(const std::string& line) const {
        const std::string names = "RTUSIM=" + program_path() +
                                  "; RUN=\"$RTUSIM run ball.glb --resolution 8x8 --workload primary\"; ";
        return Process(folder_.path(), {"/bin/sh", "-c", names + line}).wait();
    }
};

TEST_F(CommandLineErrors, WrongUsageIsExitCodeTwo) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"fly"},
                                                      {"run", "--no-such-option"},
                                                      {"run", "--preset"},
                                                      {"config", "extra"},
                                                      {"run", "--threads", "many"},
                                                      {"run", "--json", ""},
                                                      {"run", "--csv="},
                                                      {"run", "--image", ""},
                                                      {"run", "--camera", ""},
                                                      {"config", "--config", ""},
                                                      {"run", "--no\nsuch"},
                                                      {"config", "--markdown", "--compare"}}) {
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.err, StartsWith("rtusim: "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
    }
}

TEST_F(CommandLineErrors, AnUnknownCommandIsNamed) {
    const std::string err = run({"fly"}).err;
    EXPECT_THAT(err, HasSubstr("expected a command, run, trace, pairing, "));
    EXPECT_THAT(err, HasSubstr(" or config, got 'fly'"));
    EXPECT_THAT(run({}).err, HasSubstr("expected a command, run, trace, pairing, "));
}

TEST_F(CommandLineErrors, BadValuesAreNamedInOneLine) {
    expect_refusal({"run", "ball.glb", "--pairing", "window:1"}, "window:1");
    expect_refusal({"run", "ball.glb", "--edge-identity", "colour"}, "colour");
    expect_refusal({"run", "ball.glb", "--workload", "primary,specular"}, "specular");
    expect_refusal({"run", "ball.glb", "--workload", "primary,primary"}, "twice");
    expect_refusal({"run", "ball.glb", "--workload", ""}, "workload");
    expect_refusal({"run", "ball.glb", "--preset", "abacus"}, "abacus");
    expect_refusal({"run", "ball.glb", "--set", "rtu.wings=2"}, "rtu.wings");
    expect_refusal({"run", "ball.glb", "--clock-mode", "slow"}, "slow");
    expect_refusal({"config", "--preset", "abacus"}, "abacus");
    // What is quoted in a message may hold anything and still must not break its line.
    for (const char* option :
         {"--pairing", "--edge-identity", "--workload", "--preset", "--set", "--clock-mode", "--resolution",
          "--seed", "--config", "--camera", "--json", "--csv"}) {
        expect_refusal({"run", "ball.glb", option, "no\n/such\x1b thing"}, "thing");
    }
    for (const char* resolution :
         {"0x5", "16", "16x", "x16", "16x16x16", "-1x5", "16385x1", "16384x4097", "1x99999999999999999999"}) {
        expect_refusal({"run", "ball.glb", "--resolution", resolution}, resolution);
    }
    for (const char* seed : {"-1", "x", "1.5", "18446744073709551616"}) {
        expect_refusal({"run", "ball.glb", std::string("--seed=") + seed}, seed);
    }
}

TEST_F(CommandLineErrors, BadFilesAreNamedInOneLine) {
    static_cast<void>(folder_.write("empty.glb", ""));
    static_cast<void>(folder_.write("text.glb", "this is no scene"));
    static_cast<void>(folder_.write("cut.glb", content("ball.glb").substr(0, 500)));
    static_cast<void>(folder_.write("bad.toml", "[ball]\neye = 3\n"));
    for (const char* name : {"missing.glb", "empty.glb", "text.glb", "cut.glb"}) {
        expect_refusal({"run", name, "--json", "out.json", "--csv", "out.csv", "--image", "out"}, name);
        expect_refusal({"run", "ball.glb", name, "--resolution", "8x8", "--json", "out.json"}, name);
    }
    expect_refusal({"run", folder_.path()}, "expected a file");
    expect_refusal({"run", "ball.glb", "--camera", "missing.toml"}, "missing.toml");
    expect_refusal({"run", "ball.glb", "--camera", "bad.toml"}, "bad.toml:2");
    expect_refusal({"run", "ball.glb", "--config", "bad.toml"}, "bad.toml:");
}

TEST_F(CommandLineErrors, BadOutputsAreFoundBeforeTheSimulation) {
    expect_refusal({"run", "ball.glb", "--json", "no/such/folder.json"}, "no/such/folder.json");
    expect_refusal({"run", "ball.glb", "--csv", "."}, ".: cannot write");
    expect_refusal({"run", "ball.glb", "--csv", "-"}, "-: only --json can go to standard output");
    expect_refusal({"run", "ball.glb", "--image", "ball.glb"}, "expected a folder");
    expect_refusal({"run", "ball.glb", "--json", "ball.glb"}, "would be overwritten");
    static_cast<void>(folder_.write("machine.toml", ""));
    expect_refusal({"run", "ball.glb", "--config", "machine.toml", "--csv", "./machine.toml"},
                   "would be overwritten");
    expect_refusal({"run", "ball.glb", "--json", "out", "--csv", "./out"}, "same file");
    expect_refusal({"run", "ball.glb", "ball.glb", "--image", "out"}, "two scenes are called 'ball'");
}

TEST_F(CommandLineErrors, AFullDiskIsReportedAndLeavesNothing) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    expect_refusal({"run", "ball.glb", "--resolution", "8x8", "--json", "/dev/full", "--csv", "out.csv"},
                   "/dev/full: cannot write: No space left on device");
}

TEST_F(CommandLineErrors, AnInterruptEndsTheRunAtOnceWithoutAFile) {
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

TEST_F(CommandLineErrors, ClosedAndFullStreamsKeepTheExitCode) {
    EXPECT_EQ(run_shell("$RTUSIM run missing.glb 2>&-").exit_code, 1);
    EXPECT_EQ(run_shell("$RTUSIM fly 2>&-").exit_code, 2);
    const ProcessResult closed = run_shell("$RUN >&-");
    EXPECT_EQ(closed.exit_code, 1);
    EXPECT_THAT(closed.err, HasSubstr("standard output: cannot write"));
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_EQ(run_shell("$RTUSIM fly 2>/dev/full").exit_code, 2);
    for (const char* command : {"$RTUSIM --help", "$RTUSIM run --help", "$RTUSIM config", "$RUN"}) {
        const ProcessResult full = run_shell(std::string(command) + " >/dev/full");
        EXPECT_EQ(full.exit_code, 1) << command;
        EXPECT_THAT(full.err, HasSubstr("standard output: cannot write")) << command;
    }
}

TEST_F(CommandLineErrors, AReaderThatLeavesEndsTheRunWithoutATemporaryFile) {
    // The shell waits for the run's exit code, which goes to descriptor 3 past the pipe that nobody reads.
    const ProcessResult result =
        run_shell("{ { $RUN --json out.json --csv /dev/stdout; echo $? >&3; } | true; } 3>&1");
    EXPECT_EQ(result.out, std::to_string(128 + SIGPIPE) + "\n");
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb"));
}

TEST_F(CommandLineErrors, AHangUpEndsTheRunUnlessItIsIgnored) {
    const std::string hang_up =
        "$RTUSIM run --workload primary --resolution $SIZE & sleep 0.2; kill -HUP $!; wait $!";
    EXPECT_EQ(run_shell("SIZE=512x512; " + hang_up).exit_code, 128 + SIGHUP);
    EXPECT_EQ(run_shell("SIZE=64x64; trap '' HUP; " + hang_up).exit_code, 0);
}

}  // namespace
}  // namespace rtu::test
