#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/report/run_findings.hpp"
#include "study/report/run_waits.hpp"

namespace rtu::test {
namespace {

using study::RunLimit;
using testing::HasSubstr;

constexpr std::uint64_t cycles = 1000;

// Of the default machine: 128 slots, all taken, and nothing that is busy or waits.
study::WorkloadReport quiet_workload(const std::string& name = "primary") {
    study::WorkloadReport workload;
    workload.name = name;
    workload.ray_count = 500;
    workload.cycles = cycles;
    workload.units = {
        {"scheduler", {}, {{"slot_cycles", "", 128 * cycles}, {"spilled_entries", "", 0}}},
        {"box", {}, {{"issue_cycles", "", 400}, {"node_visits", "", 400}}},
        {"pair", {}, {{"tester_cycles", "", 100}, {"survivors", "", 10}, {"hit_wait_cycles", "", 250}}}};
    workload.memory = {{"l1", {}, {{"line_reads", "", 400}, {"hits", "", 300}}}};
    return workload;
}

void set(std::vector<study::UnitReport>& units, const std::string& unit, const std::string& counter,
         std::uint64_t value) {
    for (study::UnitReport& one : units) {
        if (one.name != unit) continue;
        std::erase_if(one.counters, [&](const study::CounterValue& c) { return c.name == counter; });
        one.counters.push_back({counter, "", value});
    }
}

study::SceneReport scene_of(std::vector<study::WorkloadReport> workloads) {
    study::SceneReport report;
    report.scene.name = "bunny";
    report.pairing = {"edge_bbsa", "position", 97, 0, 0, 0};
    report.workloads = std::move(workloads);
    return report;
}

study::PageFinding only_finding(const study::WorkloadReport& workload, const sim::Config& config = {}) {
    const auto findings = study::run_findings(scene_of({workload}), config);
    EXPECT_EQ(findings.size(), 1U);
    return findings.front();
}

TEST(RunFindings, NameTheFullPartAndWhatLimitsItsRelief) {
    study::WorkloadReport workload = quiet_workload();
    set(workload.units, "box", "issue_cycles", 920);
    set(workload.units, "pair", "tester_cycles", 575);
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Part);
    const study::PageFinding found = only_finding(workload);
    EXPECT_EQ(found.subject, "bunny: primary");
    EXPECT_EQ(found.text, "The limit is the box unit: 92 % of what it can do is used.");
    EXPECT_THAT(found.advice, HasSubstr("more box lanes (rtu.box.boxes_per_cycle, now 4)"));
    EXPECT_THAT(found.advice, HasSubstr("at most 1.60 times the rate: then the first pass"));
    EXPECT_THAT(found.figures, HasSubstr("box 92.0"));
    EXPECT_THAT(found.figures, HasSubstr("ray slots taken 128.0 of 128"));
}

TEST(RunFindings, AreFullFromTheThresholdOnAndNotBelow) {
    study::WorkloadReport workload = quiet_workload();
    set(workload.units, "box", "issue_cycles", std::uint64_t(study::full_percent * 10));
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Part);
    set(workload.units, "box", "issue_cycles", std::uint64_t(study::full_percent * 10) - 1);
    EXPECT_NE(study::limit_of(workload, {}), RunLimit::Part);
}

TEST(RunFindings, CountTheMachinesOwnUnits) {
    sim::Config config;
    config.rtu.pair.testers = 2;
    study::WorkloadReport workload = quiet_workload();
    set(workload.units, "pair", "tester_cycles", 1000);
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Part);
    EXPECT_NE(study::limit_of(workload, config), RunLimit::Part);
}

TEST(RunFindings, KnowEveryWait) {
    study::WorkloadReport workload = quiet_workload();
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Latency);
    EXPECT_THAT(only_finding(workload).text, HasSubstr("Reads that miss the L1: 25 %"));

    set(workload.units, "scheduler", "slot_cycles", 64 * cycles);
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::TooFewRays);
    EXPECT_THAT(only_finding(workload).text, HasSubstr("Ray slots taken: 50 %"));

    set(workload.memory, "l1", "bank_conflict_cycles", 400);
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Banks);
    EXPECT_THAT(only_finding(workload).advice, HasSubstr("l1.banks, now 4"));

    set(workload.memory, "l1", "mshr_full_cycles", 60);
    set(workload.memory, "l1", "target_full_cycles", 40);
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Mshrs);
    EXPECT_THAT(only_finding(workload).advice, HasSubstr("l1.mshrs, now 64"));

    workload.units[2].cycles.blocked = 200;
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::PairEntries);
    EXPECT_THAT(only_finding(workload).text, HasSubstr("wait for a hit unit: 25 cycles"));

    workload.units.push_back({"link", {}, {{"read_back_cycles", "", 300}, {"upload_cycles", "", 200}}});
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::Link);
    EXPECT_THAT(only_finding(workload).text, HasSubstr("no batch was in the machine: 50 %"));

    workload.ray_count = 0;
    EXPECT_EQ(study::limit_of(workload, {}), RunLimit::NoWork);
    EXPECT_EQ(only_finding(workload).text, "There was no ray to trace.");
}

TEST(RunFindings, AddTheUnitsOfSeveralRtus) {
    sim::Config config;
    config.rtu.count = 2;
    study::WorkloadReport workload = quiet_workload();
    workload.memory.push_back(workload.memory.front());
    workload.memory[0].name = "rtu0.l1";
    workload.memory[1].name = "rtu1.l1";
    set(workload.memory, "rtu0.l1", "bank_conflict_cycles", 400);
    EXPECT_DOUBLE_EQ(study::run_waits(workload, config).banks_percent, 20);
    EXPECT_DOUBLE_EQ(study::run_waits(workload, config).slots_percent(), 50);
}

TEST(RunFindings, ShareASentenceBetweenWorkloadsWithOneLimit) {
    study::WorkloadReport primary = quiet_workload(), shadow = quiet_workload("shadow");
    set(primary.units, "box", "issue_cycles", 970);
    set(shadow.units, "box", "issue_cycles", 910);
    const auto findings = study::run_findings(scene_of({primary, quiet_workload("ao"), shadow}), {});
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].subject, "bunny: primary, shadow");
    EXPECT_THAT(findings[0].text, HasSubstr("97 % (primary), 91 % (shadow)"));
    EXPECT_EQ(findings[1].subject, "bunny: ao");
}

TEST(RunFindings, TellWhatElseStandsOut) {
    study::WorkloadReport workload = quiet_workload();
    workload.node_visits = 1000;
    set(workload.units, "scheduler", "spilled_entries", 11);
    study::SceneReport report = scene_of({workload});
    report.pairing = {"window:2", "index", 41, 5, 14, 0};
    report.check = study::CheckReport{500, 1, 500, 0, 0, 0, 0};
    const auto findings = study::run_findings(report, {});
    ASSERT_EQ(findings.size(), 4U);
    EXPECT_THAT(findings[1].advice, HasSubstr("rtu.stack_entries, now 16"));
    EXPECT_THAT(findings[1].figures, HasSubstr("11 entries written for 1,000 nodes"));
    EXPECT_THAT(findings[2].text, HasSubstr("Only 41 %"));
    EXPECT_THAT(findings[2].advice, HasSubstr("--edge-identity position"));
    EXPECT_THAT(findings[3].figures, HasSubstr("1 of 500 hits differ from the reference"));
    set(report.workloads[0].units, "scheduler", "spilled_entries", 10);
    EXPECT_EQ(study::run_findings(report, {}).size(), 3U);
}

}  // namespace
}  // namespace rtu::test
