#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "study/sweep/sqlite.hpp"
#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::UnorderedElementsAre;
using Json = nlohmann::json;

// 16 designs of a scene of 264 triangles, 64 rays a workload.
const std::string small_sweep =
    "scenes = [\"ball.glb\"]\n"
    "workloads = [\"primary\", \"diffuse\"]\n"
    "resolution = [8, 8]\n"
    "objectives = [\"mrps\", \"min rtu.box.boxes_per_cycle\"]\n"
    "constraints = [\"rtu.box.boxes_per_cycle * 32 >= rtu.ray_slots\"]\n"
    "pairings = [\"none\", \"edge_bbsa\"]\n"
    "[axes]\n"
    "rtu.ray_slots = [1, 32, 64]\n"
    "rtu.box.boxes_per_cycle = { from = 1, to = 4, factor = 2 }\n"
    "[set]\n"
    "l2.size_bytes = 65536\n";

class SweepCommand : public CommandLine {
  protected:
    // A command that must succeed; what it printed.
    std::string sweep(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "sweep");
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.out;
    }
    ProcessResult shell(const std::string& line) const {
        const std::string program = "RTUSIM=" + program_path() + "; ";
        return Process(folder_.path(), {"/bin/bash", "-c", program + line}).wait();
    }
    // All rows of all tables but those of the host, as text.
    std::string tables(const std::string& database) const {
        const study::SqlDatabase sql(folder_.path() / database, study::SqlDatabase::Mode::ReadOnly);
        std::string text;
        for (const char* table : {"sweep", "design", "point", "result", "front"}) {
            study::SqlStatement rows = sql.prepare(fmt::format("SELECT * FROM {}", table));
            while (rows.next()) {
                for (int i = 0; i < rows.column_count(); ++i) text += rows.text(i) + '|';
                text += '\n';
            }
        }
        return text;
    }
    std::int64_t number(const std::string& database, const std::string& sql) const {
        const study::SqlDatabase connection(folder_.path() / database, study::SqlDatabase::Mode::ReadOnly);
        study::SqlStatement row = connection.prepare(sql);
        return row.next() ? row.integer(0) : -1;
    }
    void expect_fault(const std::string& text, const std::string& error) const {
        static_cast<void>(folder_.write("bad.toml", text));
        expect_refusal({"sweep", "bad.toml"}, error);
    }
};

TEST_F(SweepCommand, PointsGiveWhatRunsGive) {
    static_cast<void>(folder_.write("s.toml", small_sweep));
    EXPECT_THAT(sweep({"s.toml", "--json", "s.json"}),
                AllOf(HasSubstr("16 done, 0 failed"), HasSubstr("Front of mrps")));
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb", "s.toml", "s.db", "s.json"));
    const Json rows = Json::parse(content("s.json"));
    ASSERT_EQ(rows.size(), 16U * 3);
    const Json& row = rows[3 * 9 + 2];
    ASSERT_EQ(row["workload"], "total");
    std::vector<std::string> arguments{
        "run",    "ball.glb", "--resolution", "8x8",          "--workload", "primary,diffuse",
        "--json", "-",        "--pairing",    row["pairing"], "--set",      "l2.size_bytes=65536"};
    for (const char* key : {"rtu.ray_slots", "rtu.box.boxes_per_cycle"}) {
        arguments.insert(arguments.end(), {"--set", fmt::format("{}={}", key, row[key].get<int>())});
    }
    const Json report = Json::parse(run(arguments).out);
    for (const char* count : {"ray_count", "hit_count", "node_visits", "box_tests", "pair_tests",
                              "triangle_tests", "cycles", "mrps"}) {
        EXPECT_EQ(row[count], report["total"][count]) << count;
    }
    double bytes = 0;
    for (const Json& workload : report["workloads"]) {
        const Json& dram = workload["memory"]["dram"];
        bytes += dram["read_bytes"].get<double>() + dram["write_bytes"].get<double>();
    }
    EXPECT_DOUBLE_EQ(row["bytes_per_ray"], bytes / report["total"]["ray_count"].get<double>());
}

// Estimates first, and only what may be on the front in full: the same front as of simulations of everything.
TEST_F(SweepCommand, TheFrontOfEstimatesIsThatOfSimulations) {
    std::string text = small_sweep;
    text.replace(text.find("\"none\", "), 8, "");
    text.replace(text.find("[8, 8]"), 6, "[32, 32]");
    text.replace(text.find("\"min rtu.box.boxes_per_cycle\""), 29, "\"mgates\"");
    static_cast<void>(folder_.write("cycle.toml", text));
    static_cast<void>(folder_.write("auto.toml", "fidelity = \"auto\"\n" + text));
    static_cast<void>(sweep({"cycle.toml", "--front", "cycle.front"}));
    EXPECT_THAT(sweep({"auto.toml", "--front", "auto.front"}),
                AllOf(HasSubstr("Fidelity  auto; "), HasSubstr("within their interval")));
    EXPECT_EQ(Json::parse(content("auto.front"))["designs"], Json::parse(content("cycle.front"))["designs"]);
    EXPECT_EQ(number("auto.db", "SELECT count(*) FROM point WHERE fidelity = 'auto'"), 8);
    const std::int64_t simulated =
        number("auto.db", "SELECT count(*) FROM point WHERE fidelity = 'cycle' AND status = 'done'");
    EXPECT_GT(simulated, 0);
    EXPECT_LT(simulated, 8);
    EXPECT_EQ(
        number("auto.db",
               "SELECT count(*) FROM results WHERE mrps < mrps_low OR mrps > mrps_high OR level = 'auto'"),
        0);
    EXPECT_EQ(
        number("auto.db", "SELECT count(*) FROM front JOIN answers USING (design) WHERE level <> 'cycle'"),
        0);
    EXPECT_EQ(number("auto.db", "SELECT count(*) FROM answers"), 8 * 3);
    EXPECT_THAT(sweep({"auto.toml"}), HasSubstr("none were left to simulate"));
}

TEST_F(SweepCommand, EstimatesAreThoseOfRuns) {
    static_cast<void>(
        folder_.write("s.toml",
                      "scenes = [\"ball.glb\"]\nworkloads = [\"primary\"]\nresolution = [40, 40]\nfidelity = "
                      "\"analytic\"\nseed = 3\n[set]\nrtu.ray_slots = 16\n"));
    static_cast<void>(sweep({"s.toml", "--json", "s.json"}));
    const Json row = Json::parse(content("s.json"))[0];
    ASSERT_EQ(row["level"], "analytic");
    const Json report =
        Json::parse(run({"run", "ball.glb", "--resolution", "40x40", "--workload", "primary", "--seed", "3",
                         "--set", "rtu.ray_slots=16", "--fidelity", "analytic", "--json", "-"})
                        .out);
    const Json& run_row = report["rows"][0];
    // Cycles are whole in the database.
    EXPECT_NEAR(row["mrps"], run_row["mrps"].get<double>(), 0.001 * row["mrps"].get<double>());
    EXPECT_NEAR(row["mrps_low"], run_row["mrps_low"].get<double>(), 0.001 * row["mrps"].get<double>());
    EXPECT_TRUE(row["l1_hits"].is_null());
}

TEST_F(SweepCommand, ChartsAreDrawnAndTold) {
    static_cast<void>(folder_.write(
        "s.toml", small_sweep + "[[charts]]\nname = \"slots\"\ntitle = \"Slots\"\nx = \"rtu.ray_slots\"\n"
                                "panels = \"workload\"\nseries = [\"pairing\"]\n"));
    EXPECT_THAT(sweep({"s.toml"}), AllOf(HasSubstr("\nSlots\nmrps by rtu.ray_slots: geometric mean"),
                                         HasSubstr("diffuse   edge_bbsa")));
    const ProcessResult result = run({"sweep", "s.toml", "--charts", "pictures"});
    if (result.err.find("gnuplot") != std::string::npos) GTEST_SKIP() << "gnuplot is not installed";
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(content("pictures/slots.svg"), HasSubstr("<svg"));
}

// Files that are not beside the sweep file are looked for where --scenes says.
TEST_F(SweepCommand, ScenesMayLieElsewhere) {
    std::filesystem::create_directories(folder_.path() / "sweeps");
    static_cast<void>(folder_.write("sweeps/s.toml", small_sweep));
    EXPECT_EQ(run({"sweep", "sweeps/s.toml", "--dry-run"}).exit_code, 1);
    EXPECT_EQ(run({"sweep", "sweeps/s.toml", "--dry-run", "--scenes", "."}).exit_code, 0);
}

TEST_F(SweepCommand, AnyNumberOfWorkersGivesTheSame) {
    static_cast<void>(folder_.write("s.toml", small_sweep));
    const std::string one = sweep({"s.toml", "--workers", "1", "--output", "one.db", "--csv", "one.csv",
                                   "--columns", "one.columns", "--front", "one.front"});
    const std::string three = sweep({"s.toml", "--workers", "3", "--output", "three.db", "--csv", "three.csv",
                                     "--columns", "three.columns", "--front", "three.front"});
    EXPECT_EQ(tables("one.db"), tables("three.db"));
    EXPECT_EQ(content("one.csv"), content("three.csv"));
    EXPECT_EQ(content("one.columns"), content("three.columns"));
    EXPECT_EQ(content("one.front"), content("three.front"));
    EXPECT_EQ(run({"diff", "one.db", "three.db", "--tolerance", "0"}).exit_code, 0);
    const Json columns = Json::parse(content("one.columns"));
    EXPECT_EQ(columns["types"]["rtu_ray_slots"], "int64");
    EXPECT_EQ(columns["types"]["rtu_pair_mode"], "string");
    EXPECT_EQ(columns["types"]["primary_mrps"], "double");
    for (const auto& [name, values] : columns["columns"].items()) EXPECT_EQ(values.size(), 16U) << name;
    EXPECT_FALSE(Json::parse(content("one.front"))["designs"].empty());
}

TEST_F(SweepCommand, ASecondRunSimulatesNothingAndALargerSweepOnlyWhatIsNew) {
    static_cast<void>(folder_.write("s.toml", small_sweep));
    static_cast<void>(sweep({"s.toml"}));
    EXPECT_THAT(sweep({"s.toml"}), HasSubstr("none were left to simulate"));
    std::string larger = small_sweep;
    larger.replace(larger.find("[1, 32, 64]"), 11, "[1, 32, 64, 16]");
    static_cast<void>(folder_.write("s.toml", larger));
    EXPECT_THAT(sweep({"s.toml"}), AllOf(HasSubstr("22 done, 0 failed"), HasSubstr("; 6 in this run")));
    EXPECT_EQ(number("s.db", "SELECT max(completions) FROM host"), 1);
}

TEST_F(SweepCommand, ADryRunShowsThePointsAndRunsNothing) {
    static_cast<void>(folder_.write("s.toml", small_sweep));
    EXPECT_THAT(sweep({"s.toml", "--dry-run"}),
                AllOf(HasSubstr("16 points"), HasSubstr("18 designs before constraints"),
                      HasSubstr("of CPU time"), HasSubstr("boxes_per_cycle")));
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb", "s.toml"));
}

TEST_F(SweepCommand, RaysAndTraversalsOfFilesAreReplayed) {
    for (const char* visits : {"", "--visits"}) {
        std::vector<std::string> record{
            "trace",        "record", "ball.glb",   std::string("a") + visits + ".rtutrace",
            "--resolution", "8x8",    "--workload", "primary,diffuse"};
        if (*visits != '\0') record.emplace_back(visits);
        ASSERT_EQ(run(record).exit_code, 0);
    }
    const std::string rest = "[axes]\nrtu.ray_slots = [1, 8]\n";
    static_cast<void>(folder_.write(
        "s.toml",
        "scenes = [\"ball.glb\", { scene = \"ball.glb\", rays = \"a.rtutrace\" }, { scene = \"ball.glb\", "
        "rays = "
        "\"a--visits.rtutrace\" }]\nworkloads = [\"primary\", \"diffuse\"]\nresolution = [8, 8]\n" +
            rest));
    static_cast<void>(sweep({"s.toml", "--json", "s.json"}));
    const Json rows = Json::parse(content("s.json"));
    ASSERT_EQ(rows.size(), 18U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(rows[i]["cycles"], rows[i + 6]["cycles"]);
        EXPECT_EQ(rows[i]["cycles"], rows[i + 12]["cycles"]);
    }
}

TEST_F(SweepCommand, BadSweepsRunNothing) {
    expect_fault("scenes = [\"ball.glb\"]\nworkload = 1\n", "bad.toml:2: expected one of scenes, ");
    expect_fault("scenes = [\"ball.glb\"]\n[axes]\nl1.size_bytes = [65536, 3072]\n",
                 "bad.toml:3: expected a capacity of a power of two sets");
    expect_fault("scenes = [\"bad.toml\"]\n", "bad.toml");
    static_cast<void>(folder_.write("s.toml", small_sweep));
    const ProcessResult itself = run({"sweep", "s.toml", "--output", "s.toml"});
    EXPECT_EQ(itself.exit_code, 1);
    EXPECT_THAT(itself.err, HasSubstr("is an input of this run"));
    EXPECT_EQ(run({"sweep", "s.toml", "--output", "ball2.glb", "--csv", "ball2.glb"}).exit_code, 1);
    EXPECT_EQ(run({"sweep"}).exit_code, 2);
    EXPECT_EQ(run({"sweep", "s.toml", "--executor", "cloud"}).exit_code, 2);
    EXPECT_EQ(run({"sweep", "--help"}).exit_code, 0);
    EXPECT_THAT(run({"--help"}).out, testing::Not(HasSubstr("sweep-worker")));
}

TEST_F(SweepCommand, DiffTellsWhatChanged) {
    const auto report = [&](const char* name, const char* slots) {
        EXPECT_EQ(run_ball({"--set", std::string("rtu.ray_slots=") + slots, "--json", name}).exit_code, 0);
    };
    report("a.json", "8");
    report("b.json", "8");
    report("c.json", "9");
    EXPECT_THAT(run({"diff", "a.json", "b.json", "--tolerance", "0"}).out, StartsWith("0 of "));
    const ProcessResult other = run({"diff", "a.json", "c.json"});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_THAT(other.out, AllOf(HasSubstr("ball rtu.ray_slots: 8 -> 9"), HasSubstr("cycles")));
    EXPECT_EQ(run({"diff", "a.json", "ball.glb"}).exit_code, 1);
    EXPECT_EQ(run({"diff", "a.json", "gone.json"}).exit_code, 1);
    EXPECT_EQ(run({"diff", "a.json"}).exit_code, 2);
    static_cast<void>(folder_.write("s.toml", small_sweep));
    static_cast<void>(sweep({"s.toml", "--output", "a.db"}));
    std::string other_seed = small_sweep;
    static_cast<void>(folder_.write("s.toml", "seed = 5\n" + small_sweep));
    static_cast<void>(sweep({"s.toml", "--output", "b.db"}));
    const ProcessResult sweeps = run({"diff", "a.db", "b.db", "--tolerance", "0"});
    EXPECT_EQ(sweeps.exit_code, 3);
    EXPECT_THAT(sweeps.out, AllOf(HasSubstr("ball rays: "), HasSubstr("Sign test"), HasSubstr("cycles")));
    EXPECT_EQ(run({"diff", "a.db", "a.json"}).exit_code, 1);
}

// The examples of docs/sweeps.md.
TEST_F(SweepCommand, ExamplesAreSweeps) {
    std::size_t count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(RTUSIM_SOURCE_DIR) + "/docs/sweeps")) {
        EXPECT_THAT(sweep({entry.path().string(), "--dry-run"}), HasSubstr("Estimate")) << entry.path();
        ++count;
    }
    EXPECT_EQ(count, 3U);
}

// A machine that needs more memory than there may be: its point fails, the others do not.
TEST_F(SweepCommand, FailedPointsAreListedAndTheOthersDone) {
    if (sanitized_program() != nullptr)
        GTEST_SKIP() << "the address sanitizer needs all of the address space";
    static_cast<void>(folder_.write(
        "s.toml",
        "scenes = [\"ball.glb\"]\nworkloads = [\"primary\"]\nresolution = [4, 4]\n[set]\nl2.line_bytes = 32\n"
        "l1.line_bytes = 32\nl1.sector_bytes = 32\nl2.sector_bytes = 32\n"
        "[axes]\nl2.size_bytes = [65536, 268435456, 131072]\n"));
    const ProcessResult limited = shell("ulimit -v 350000; $RTUSIM sweep s.toml --workers 1");
    EXPECT_EQ(limited.exit_code, 3) << limited.err;
    EXPECT_THAT(limited.out, AllOf(HasSubstr("2 done, 1 failed"), HasSubstr("bad_alloc")));
    EXPECT_THAT(limited.err, HasSubstr("1 points failed"));
    const ProcessResult again = run({"sweep", "s.toml"});
    EXPECT_EQ(again.exit_code, 3);
    EXPECT_THAT(again.out, AllOf(HasSubstr("none were left"), HasSubstr("bad_alloc")));
    EXPECT_THAT(sweep({"s.toml", "--retry-failed"}), HasSubstr("3 done, 0 failed; 1 in this run"));
}

TEST_F(SweepCommand, AFullDiskStopsItAndASecondRunFinishes) {
    static_cast<void>(folder_.write("s.toml", small_sweep));
    static_cast<void>(sweep({"s.toml", "--output", "whole.db"}));
    for (const int kibibytes : {4, 40, 60}) {  // the first of these ends with the list of points
        const ProcessResult full = shell(fmt::format(
            "trap '' XFSZ; ulimit -f {}; $RTUSIM sweep s.toml --output s.db --workers 1", kibibytes));
        EXPECT_EQ(full.exit_code, 1) << kibibytes << ": " << full.out;
        EXPECT_THAT(full.err, StartsWith("rtusim: ")) << kibibytes;
    }
    static_cast<void>(sweep({"s.toml", "--output", "s.db"}));
    EXPECT_EQ(tables("s.db"), tables("whole.db"));
    EXPECT_EQ(number("s.db", "SELECT max(completions) FROM host"), 1);
    EXPECT_THAT(names(), UnorderedElementsAre("ball.glb", "s.toml", "s.db", "whole.db"));
}

TEST_F(SweepCommand, TwoSweepsDoNotShareADatabase) {
    static_cast<void>(folder_.write("s.toml", small_sweep));
    std::filesystem::create_directory(folder_.path() / "s.db.work");
    const ProcessResult second = shell("flock s.db.work/lock $RTUSIM sweep s.toml");
    EXPECT_EQ(second.exit_code, 1);
    EXPECT_THAT(second.err, HasSubstr("another sweep works there"));
}

// Kills the sweep or one of its workers at random moments, 50 times, and starts it again.
class SweepKills : public SweepCommand {
  protected:
    static std::string sweep_text(int designs) {
        return fmt::format(
            "scenes = [\"ball.glb\"]\nworkloads = [\"primary\", \"diffuse\"]\nresolution = [16, 16]\n"
            "pairings = [\"none\", \"edge_bbsa\"]\n[axes]\nrtu.ray_slots = {{ from = 1, to = {}, step = 1 "
            "}}\n",
            designs);
    }
    static std::vector<pid_t> children(pid_t parent) {
        std::ifstream stream(fmt::format("/proc/{0}/task/{0}/children", parent));
        std::vector<pid_t> result;
        for (pid_t child = 0; stream >> child;) result.push_back(child);
        return result;
    }
    void pause() { ::usleep(std::uniform_int_distribution<unsigned>(0, 100'000)(random_)); }
    // True when the sweep came to its end before it was killed.
    bool start_and_kill(const std::string& database) {
        Process process = start({"sweep", "s.toml", "--output", database});
        pause();
        const std::vector<pid_t> workers = children(process.id());
        if (!workers.empty() && random_() % 2 == 0) {
            ::kill(workers[random_() % workers.size()], SIGKILL);
            ++kills_;
            pause();
        }
        ::kill(process.id(), SIGKILL);
        const ProcessResult result = process.wait();
        if (result.exit_code < 0) ++kills_;
        EXPECT_LE(result.exit_code, 0) << result.err;
        return result.exit_code == 0;
    }
    std::mt19937 random_{20};
    int kills_ = 0;
};

TEST_F(SweepKills, NoPointIsLostAndNoneIsDoneTwice) {
    static_cast<void>(folder_.write("s.toml", sweep_text(100)));
    static_cast<void>(sweep({"s.toml", "--output", "whole.db"}));
    const std::string expected = tables("whole.db");
    int finished = 0;
    while (kills_ < 50) {
        const std::string database = fmt::format("s{}.db", finished);
        if (!start_and_kill(database)) continue;
        EXPECT_EQ(tables(database), expected);
        EXPECT_EQ(number(database, "SELECT sum(completions) FROM host"), 200);
        ++finished;
    }
    const std::string database = fmt::format("s{}.db", finished);
    static_cast<void>(sweep({"s.toml", "--output", database}));
    EXPECT_EQ(tables(database), expected);
    EXPECT_EQ(number(database, "SELECT max(completions) FROM host"), 1);
    EXPECT_EQ(number(database, "SELECT count(*) FROM host"), 200);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / (database + ".work")));
}

}  // namespace
}  // namespace rtu::test
