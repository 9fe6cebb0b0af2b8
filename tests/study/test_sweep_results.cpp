#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>

#include "model/error.hpp"
#include "study/area/area_objective.hpp"
#include "study/report/result_diff.hpp"
#include "study/sweep/child_process.hpp"
#include "study/sweep/sweep_database.hpp"
#include "study/sweep/sweep_executor.hpp"
#include "study/sweep/sweep_front.hpp"
#include "study/sweep/sweep_journal.hpp"
#include "tests/model/gltf_builder.hpp"

namespace rtu::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SweepResults : public testing::Test {
  protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

    static SweepResult result(const SweepPlan& plan, std::size_t point, std::uint64_t cycles) {
        SweepResult result;
        result.point = plan.points[point].id;
        result.cpu_seconds = 0.5;
        std::vector<std::optional<std::uint64_t>> counts(sweep_counts().size(), 10);
        counts[6] = cycles;
        for (const char* workload : {"primary", "total"})
            result.rows.push_back({workload, "cycle", double(cycles), double(cycles), counts});
        return result;
    }
    static SweepPlan plan() {
        return make_sweep_plan(
            parse_sweep("scenes = [\"builtin\"]\nobjectives = [\"mrps\", \"min "
                        "rtu.ray_slots\"]\n[axes]\nrtu.ray_slots = [1, 2, 4]\n",
                        "s.toml"));
    }
    void append(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::app | std::ios::binary) << text;
    }

    test::TemporaryFolder folder_;
};

TEST_F(SweepResults, AJournalGivesWholeLinesOnly) {
    JournalWriter writer(path("a.journal"));
    writer.add("one");
    writer.add("two");
    const JournalPart first = read_journal(path("a.journal"), 0);
    EXPECT_THAT(first.lines, ElementsAre("one", "two"));
    append("a.journal", "0123");  // the part of a line that a full disk leaves
    EXPECT_THAT(read_journal(path("a.journal"), first.end).lines, IsEmpty());
    append("a.journal", "456789abcdef three\n");
    EXPECT_THAT(read_journal(path("a.journal"), first.end).lines, IsEmpty()) << "a wrong checksum";
    EXPECT_EQ(read_journal(path("a.journal"), first.end).end, first.end);
    EXPECT_THROW(JournalWriter(path("a.journal")), Error);
}

TEST_F(SweepResults, ResultsSurviveTheirLine) {
    const SweepPlan sweep = plan();
    SweepResult before = result(sweep, 1, 77);
    before.paired_percent = 1.0 / 3;
    before.rows[0].level = "analytic";
    before.rows[0].counts[3].reset();
    before.rows[0].cycles_high.reset();
    const SweepResult after = parse_sweep_result(to_json_line(before));
    EXPECT_EQ(to_json_line(after), to_json_line(before));
    EXPECT_EQ(after.rows[1].counts, before.rows[1].counts);
    EXPECT_THROW(static_cast<void>(parse_sweep_result("{}")), Error);
}

// Every line counts once, whatever was interrupted between import and removal.
TEST_F(SweepResults, JournalsAreImportedOnce) {
    const SweepPlan sweep = plan();
    JournalWriter journal(path("a.journal"));
    journal.add(to_json_line(result(sweep, 0, 100)));
    {
        SweepDatabase database(path("s.db"), SqlDatabase::Mode::ReadWrite);
        database.set_plan(sweep);
        EXPECT_EQ(database.import_journals(folder_.path()).size(), 1U);
    }
    SweepDatabase database(path("s.db"), SqlDatabase::Mode::ReadWrite);
    database.forget_journals(folder_.path());
    EXPECT_EQ(database.import_journals(folder_.path()).size(), 0U);
    journal.add(to_json_line(result(sweep, 1, 200)));
    EXPECT_EQ(database.import_journals(folder_.path()).size(), 1U);
    EXPECT_THAT(database.waiting(), ElementsAre(2));
    SqlStatement completions = database.sql().prepare("SELECT sum(completions), count(*) FROM host");
    ASSERT_TRUE(completions.next());
    EXPECT_EQ(completions.integer(0), 2);
    EXPECT_EQ(completions.integer(1), 2);
    static_cast<void>(completions.next());
    JournalWriter again(path("b.journal"));
    again.add(to_json_line(result(sweep, 1, 999)));
    EXPECT_EQ(database.import_journals(folder_.path()).size(), 0U);
    SqlStatement kept = database.sql().prepare("SELECT max(cycles) FROM result");
    ASSERT_TRUE(kept.next());
    EXPECT_EQ(kept.integer(0), 200);
}

TEST_F(SweepResults, FailedPointsKeepTheirErrorAndAreTriedAgainWhenAsked) {
    const SweepPlan sweep = plan();
    SweepDatabase database(path("s.db"), SqlDatabase::Mode::ReadWrite);
    database.set_plan(sweep);
    database.add_failure(sweep.points[1].id, "its process died");
    ASSERT_EQ(database.failures().size(), 1U);
    EXPECT_EQ(database.failures()[0].error, "its process died");
    EXPECT_THAT(database.waiting(), ElementsAre(0, 2));
    database.set_plan(sweep);
    EXPECT_EQ(database.counts().failed, 1U);
    database.retry_failed();
    EXPECT_THAT(database.waiting(), ElementsAre(0, 1, 2));
}

TEST_F(SweepResults, ALargerPlanKeepsWhatIsDone) {
    const SweepPlan small = plan();
    SweepDatabase database(path("s.db"), SqlDatabase::Mode::ReadWrite);
    database.set_plan(small);
    JournalWriter journal(path("a.journal"));
    journal.add(to_json_line(result(small, 2, 5)));
    static_cast<void>(database.import_journals(folder_.path()));
    const SweepPlan large = make_sweep_plan(
        parse_sweep("scenes = [\"builtin\"]\n[axes]\nrtu.ray_slots = [3, 4, 5, 6]\n", "s.toml"));
    database.set_plan(large);
    EXPECT_EQ(database.counts().total(), 4U);
    EXPECT_THAT(database.waiting(), ElementsAre(0, 2, 3));
}

TEST_F(SweepResults, OtherFilesAreNotTouched) {
    append("text.db", "no database");
    EXPECT_THROW(SweepDatabase(path("text.db"), SqlDatabase::Mode::ReadWrite), Error);
    SqlDatabase(path("other.db"), SqlDatabase::Mode::ReadWrite).execute("CREATE TABLE t(a)");
    EXPECT_THROW(SweepDatabase(path("other.db"), SqlDatabase::Mode::ReadWrite), Error);
    EXPECT_THROW(SweepDatabase(path("gone.db"), SqlDatabase::Mode::ReadOnly), Error);
}

TEST_F(SweepResults, TheViewComputesTheMeasures) {
    const SweepPlan sweep = plan();
    SweepDatabase database(path("s.db"), SqlDatabase::Mode::ReadWrite);
    database.set_plan(sweep);
    JournalWriter journal(path("a.journal"));
    journal.add(to_json_line(result(sweep, 0, 40)));
    static_cast<void>(database.import_journals(folder_.path()));
    SqlStatement row = database.sql().prepare(
        "SELECT mrps, bytes_per_ray, box_utilisation, pair_utilisation, mrps_low, mrps_high, mgates, "
        "mrps_per_mgate FROM results WHERE workload = "
        "'total'");
    ASSERT_TRUE(row.next());
    EXPECT_DOUBLE_EQ(row.real(0), 10.0 / 40 * 1000);         // rays / cycles * MHz
    EXPECT_DOUBLE_EQ(row.real(1), 2.0);                      // (10 + 10) bytes / 10 rays
    EXPECT_DOUBLE_EQ(row.real(2), 100.0 * 10 / (40.0 * 4));  // of 4 lanes
    EXPECT_DOUBLE_EQ(row.real(3), 100.0 * 10 / 40);
    EXPECT_DOUBLE_EQ(row.real(4), row.real(0)) << "every ray: no interval";
    EXPECT_DOUBLE_EQ(row.real(5), row.real(0));
    EXPECT_DOUBLE_EQ(row.real(6), machine_gates(sweep.designs[0].config) / 1e6);
    EXPECT_DOUBLE_EQ(row.real(7), row.real(0) / row.real(6));
}

TEST(SweepFront, HasWhatNoOtherBeats) {
    const std::vector<SweepObjective> objectives{{"mrps", true}, {"l1.size_bytes", false}};
    const auto ids = [&](std::vector<RatedDesign> designs) {
        std::vector<std::string> result;
        for (const RatedDesign& design : pareto_front(std::move(designs), objectives))
            result.push_back(design.id);
        return result;
    };
    EXPECT_THAT(ids({{"small", {1, 1}},
                     {"worse", {1, 2}},
                     {"fast", {9, 9}},
                     {"middle", {5, 5}},
                     {"bad", {4, 6}},
                     {"slow", {4, 5}}}),
                ElementsAre("fast", "middle", "small"));
    EXPECT_THAT(ids({{"a", {3, 3}}, {"b", {3, 3}}}), ElementsAre("a", "b"));
    EXPECT_THAT(ids({}), IsEmpty());
}

TEST(ResultDiff, ToldChangesAreThoseThatThereAre) {
    const ResultSet before{false, {{"seed", "1"}}, {{"a total", {{"cycles", 1000}, {"hits", 5}}}, {"b", {}}}};
    ResultSet after = before;
    EXPECT_FALSE(compare(before, after, 0).is_significant());
    after.rows["a total"]["cycles"] = 1004;
    EXPECT_FALSE(compare(before, after, 0.5).is_significant());
    const ResultDiff diff = compare(before, after, 0.3);
    EXPECT_TRUE(diff.is_significant());
    ASSERT_EQ(diff.changes.size(), 1U);
    EXPECT_EQ(diff.compared, 2U);
    EXPECT_NEAR(diff.changes[0].percent(), 0.4, 1e-9);
    EXPECT_THAT(diff_text(diff, false, 0.3), HasSubstr("+0.400"));
    after.inputs["seed"] = "2";
    EXPECT_THAT(compare(before, after, 9).inputs, ElementsAre("seed: 1 -> 2"));
    after.rows.erase("b");
    EXPECT_TRUE(compare(before, after, 9).is_significant());
    ResultSet sweep = before;
    sweep.is_sweep = true;
    EXPECT_THROW(static_cast<void>(compare(before, sweep, 0)), Error);
}

TEST(ResultDiff, ZeroToSomethingIsSignificant) {
    const ResultSet before{false, {}, {{"a", {{"x", 0}}}}}, after{false, {}, {{"a", {{"x", 1}}}}};
    EXPECT_TRUE(compare(before, after, 1e6).is_significant());
}

TEST(ResultDiff, TheSignTestIsTheBinomialOne) {
    EXPECT_DOUBLE_EQ(sign_test(0, 0), 1);
    EXPECT_NEAR(sign_test(0, 5), 2 * std::pow(0.5, 5), 1e-12);
    EXPECT_NEAR(sign_test(1, 5), 2 * 7 * std::pow(0.5, 6), 1e-12);  // 1 + 6 of 64
    EXPECT_DOUBLE_EQ(sign_test(4, 4), 1);
}

TEST(ChildProcess, TellsHowItEnded) {
    EXPECT_EQ(output_of({"/bin/sh", "-c", "echo a; echo b"}), "a\nb\n");
    EXPECT_THROW(static_cast<void>(output_of({"/bin/sh", "-c", "exit 3"})), Error);
    EXPECT_THROW(ChildProcess({"/nonexistent/program"}), Error);
    ChildProcess killed({"/bin/sh", "-c", "kill -9 $$"});
    EXPECT_THAT(describe_end(killed.wait()), HasSubstr("signal 9"));
}

// A worker that is a shell script: it answers every point but those that kill it, or it says that it cannot.
class LocalExecutor : public SweepResults {
  protected:
    SweepWork work(const std::string& answer) {
        const std::filesystem::path program = path("worker");
        std::ofstream(program) << "#!/bin/sh\nwhile read p; do " << answer << "; done\n";
        ::chmod(program.c_str(), 0755);
        SweepWork work{program, folder_.path(), path("list"), {}, {}, {}, {}};
        for (std::size_t i = 0; i < 20; ++i) work.waiting.push_back(i);
        work.look = [] {};
        work.still_waiting = [this] { return waiting_; };
        work.give_up = [this](std::size_t point, const std::string& error) {
            given_up_.push_back(point);
            error_ = error;
        };
        return work;
    }
    std::string answered() const {
        std::ifstream stream(path("answered"));
        std::string text;
        std::getline(stream, text, '\0');
        return text;
    }
    std::vector<std::size_t> waiting_{7};
    std::vector<std::size_t> given_up_;
    std::string error_;
};

TEST_F(LocalExecutor, GivesUpAPointThatKillsItsProcessThreeTimes) {
    const std::string log = path("answered").string();
    run_local(work("[ $p = 7 ] && { echo died >> " + log + "; kill -SEGV $$; }; echo done $p"), 2);
    EXPECT_THAT(given_up_, ElementsAre(7));
    EXPECT_THAT(error_, HasSubstr("was ended by signal 11 (Segmentation fault), 3 times"));
    EXPECT_EQ(answered(), "died\ndied\ndied\n");
}

TEST_F(LocalExecutor, APointThatIsInTheJournalIsNotDoneAgain) {
    waiting_ = {};
    const std::string log = path("answered").string();
    run_local(work("[ $p = 7 ] && { echo died >> " + log + "; kill -KILL $$; }; echo done $p"), 2);
    EXPECT_THAT(given_up_, IsEmpty());
    EXPECT_EQ(answered(), "died\n");
}

TEST_F(LocalExecutor, StartsAnotherProcessAfterAPointThatFailed) {
    const std::string log = path("answered").string();
    run_local(work("echo $$ >> " + log + "; [ $p = 3 ] && { echo failed $p; exit 0; }; echo done $p"), 1);
    EXPECT_THAT(given_up_, IsEmpty());
    std::istringstream lines(answered());
    std::vector<std::string> processes;
    for (std::string line; std::getline(lines, line);) processes.push_back(line);
    ASSERT_EQ(processes.size(), 20U);
    EXPECT_EQ(processes[0], processes[3]);
    EXPECT_NE(processes[3], processes[4]);
    EXPECT_EQ(processes[4], processes[19]);
}

TEST_F(LocalExecutor, StopsWhenAWorkerCannotGoOn) {
    try {
        run_local(work("echo error no space left; exit 1"), 2);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "no space left");
    }
}

}  // namespace
}  // namespace rtu::study
