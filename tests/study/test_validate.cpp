#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "sim/effective_config.hpp"
#include "sim/machine.hpp"
#include "study/validate/validate_configs.hpp"
#include "study/validate/validate_output.hpp"
#include "study/validate/validate_study.hpp"

namespace rtu::study {
namespace {

using testing::HasSubstr;

sim::Config config_of(const std::vector<std::string>& sets) {
    return sim::load_config("default", std::nullopt, sets).config;
}

// The simulator itself, a hundredth slower: a reference whose errors are known.
ReferenceResult slower_simulator(const sim::Config& config, const model::MemoryImage& image,
                                 std::span<const model::Ray> rays, model::RayKind kind) {
    sim::MachineResult result = sim::simulate(config, image, rays, kind);
    ReferenceResult reference;
    reference.cycles = result.cycles + result.cycles / 100;
    reference.counts = result.counts;
    for (const sim::UnitResult& unit : result.units) {
        for (const sim::CounterValue& counter : unit.counters) {
            if (counter.name == "spilled_entries") reference.spilled_entries += counter.value;
        }
    }
    reference.hits = std::move(result.hits);
    return reference;
}

ValidateOptions builtin_options(ReferenceMachine reference) {
    ValidateOptions options;
    options.scenes = {SceneSource{}};
    options.workloads = {model::WorkloadKind::Primary, model::WorkloadKind::Shadow};
    options.configs = {{"base", {}, config_of({})},
                       {"stack_2", {"rtu.stack_entries=2"}, config_of({"rtu.stack_entries=2"})},
                       {"width_2", {"bvh.width=2"}, config_of({"bvh.width=2"})}};
    options.ray_count = 100;
    options.reference = std::move(reference);
    return options;
}

TEST(Validation, TellsTheErrorOfTheSimulatorsCycles) {
    const ValidateReport report = run_validation(builtin_options(slower_simulator));
    ASSERT_FALSE(report.difference) << report.difference->what;
    ASSERT_EQ(report.rows.size(), 6U);
    for (const ValidateRow& row : report.rows) {
        EXPECT_GT(row.rays, 50U);
        EXPECT_NEAR(row.error_percent(), -100.0 / 101, 0.02);
        EXPECT_GT(row.sim_cpu_seconds, 0);
        EXPECT_GT(row.rtl_cpu_seconds, 0);
    }
    EXPECT_NE(report.rows[0].sim_cycles, report.rows[4].sim_cycles);  // another tree
    const ErrorSummary summary = error_summary(report.rows);
    EXPECT_EQ(summary.rows, 6U);
    EXPECT_EQ(summary.within_2_percent, 6U);
    EXPECT_NEAR(summary.median_percent, 0.99, 0.02);
    EXPECT_THAT(validate_answer(report), HasSubstr("All hits and counts of 6 runs are the same"));
}

TEST(Validation, EndsAtTheFirstHitThatDiffers) {
    const auto wrong = [calls = 0](const sim::Config& config, const model::MemoryImage& image,
                                   std::span<const model::Ray> rays, model::RayKind kind) mutable {
        ReferenceResult result = slower_simulator(config, image, rays, kind);
        if (++calls == 3) {
            result.hits[7].reset();
            result.hits[9].reset();
        }
        return result;
    };
    const ValidateReport report = run_validation(builtin_options(wrong));
    ASSERT_TRUE(report.difference);
    EXPECT_EQ(report.rows.size(), 2U);
    EXPECT_EQ(report.difference->ray, 7U);
    EXPECT_EQ(report.difference->config, "stack_2");
    EXPECT_EQ(report.difference->workload, "primary");
    EXPECT_THAT(report.difference->what, HasSubstr("got a miss"));
    EXPECT_THAT(validate_answer(report), HasSubstr("builtin, stack_2, primary, ray 7: expected triangle "));
}

TEST(Validation, EndsAtTheFirstCountThatDiffers) {
    const auto broken = [](auto change) {
        return [change](const sim::Config& config, const model::MemoryImage& image,
                        std::span<const model::Ray> rays, model::RayKind kind) {
            ReferenceResult result = slower_simulator(config, image, rays, kind);
            change(result);
            return result;
        };
    };
    const auto difference = [&](auto change) {
        return run_validation(builtin_options(broken(change))).difference.value_or(ValidateDifference{}).what;
    };
    EXPECT_THAT(difference([](ReferenceResult& r) { ++r.counts.node_visits; }), HasSubstr("node visits"));
    EXPECT_THAT(difference([](ReferenceResult& r) { ++r.counts.box_tests; }), HasSubstr("box tests"));
    EXPECT_THAT(difference([](ReferenceResult& r) { ++r.counts.pair_tests; }), HasSubstr("pair tests"));
    EXPECT_THAT(difference([](ReferenceResult& r) { ++r.counts.triangle_tests; }),
                HasSubstr("triangle tests"));
    EXPECT_THAT(difference([](ReferenceResult& r) { ++r.spilled_entries; }), HasSubstr("spilled"));
    EXPECT_THAT(difference([](ReferenceResult& r) { r.hits.pop_back(); }), HasSubstr("no answer"));
}

// The reference stays what it is, so the error is that of the change.
TEST(Validation, ChangesTheSimulatorAlone) {
    std::vector<std::string> slots;
    const ReferenceMachine reference = [&](const sim::Config& config, const auto& image, auto rays,
                                           auto kind) {
        slots.push_back(fmt::format("{} {}", config.rtu.ray_slots, config.rtu.scheduler.latency_cycles));
        return slower_simulator(config, image, rays, kind);
    };
    ValidateOptions options = builtin_options(reference);
    options.configs = {validate_configs().front()};
    options.configs[0].simulated =
        simulated_instead(options.configs[0], {"rtu.scheduler.latency_cycles=40", "rtu.ray_slots=4"});
    options.workloads.resize(1);
    const ValidateReport report = run_validation(options);
    ASSERT_FALSE(report.difference) << report.difference->what;
    EXPECT_THAT(slots, testing::ElementsAre("64 3"));
    EXPECT_GT(report.rows[0].error_percent(), 100);
    EXPECT_THROW(static_cast<void>(simulated_instead(options.configs[0], {"bvh.width=2"})), Error);
    EXPECT_THROW(static_cast<void>(simulated_instead(options.configs[0], {"rtu.slots=2"})), Error);
}

TEST(Validation, GivesFewSlotsFewRays) {
    EXPECT_EQ(rays_for(2000, config_of({"rtu.ray_slots=64"})), 2000U);
    EXPECT_EQ(rays_for(2000, config_of({"rtu.ray_slots=4"})), 500U);
    EXPECT_EQ(rays_for(100, config_of({"rtu.ray_slots=1"})), 32U);
    EXPECT_EQ(rays_for(10, config_of({"rtu.ray_slots=1"})), 10U);
}

ValidateReport example_report() {
    ValidateReport report;
    report.configs = {{"base", {}, {}}, {"slots_4", {"rtu.ray_slots=4"}, {}}};
    for (const auto& [config, sim_cycles] : {std::pair{"base", 1010}, {"base", 970}, {"slots_4", 1000}}) {
        ValidateRow& row = report.rows.emplace_back();
        row.scene = "hall";
        row.workload = "primary";
        row.config = config;
        row.rays = 100;
        row.rtl_cycles = 1000;
        row.sim_cycles = std::uint64_t(sim_cycles);
        row.clock_mhz = 1000;
        row.rtl_cpu_seconds = 2;
        row.sim_cpu_seconds = 0.01;
    }
    return report;
}

TEST(ValidateReport, CountsTheExactRunsWithoutOpenSides) {
    ValidateReport report = example_report();
    EXPECT_EQ(exact_rows(report.rows).without_side_tests, 3U);
    EXPECT_EQ(exact_rows(report.rows).exact, 1U);
    for (ValidateRow& row : report.rows) row.side_tests = 2;
    report.rows[0].side_tests = 0;
    EXPECT_EQ(exact_rows(report.rows).without_side_tests, 1U);
    EXPECT_EQ(exact_rows(report.rows).exact, 0U);
}

TEST(ValidateReport, SumsErrorsUp) {
    const ErrorSummary summary = error_summary(example_report().rows);
    EXPECT_DOUBLE_EQ(summary.worst_percent, 3);
    EXPECT_DOUBLE_EQ(summary.median_percent, 1);
    EXPECT_EQ(summary.within_2_percent, 2U);
    EXPECT_DOUBLE_EQ(speedup(example_report().rows), 200);
    EXPECT_EQ(error_summary({}).rows, 0U);
}

TEST(ValidateReport, SaysTheSameAsTextJsonAndCsv) {
    const ValidateReport report = example_report();
    const std::string text = validate_text(report);
    for (const char* part :
         {"off by 3.00 % at most, 1.00 % in the median", "200 times", "rtu.ray_slots=4", "-3.00", "+1.00"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    const auto document = nlohmann::json::parse(validate_json(report));
    EXPECT_EQ(document["summary"]["worst_percent"], 3.0);
    EXPECT_TRUE(document["difference"].is_null());
    for (const char* key : {"scene", "workload", "config", "rtl_cycles", "sim_cycles", "error_percent",
                            "rtl_rays_per_second", "sim_rays_per_second"}) {
        EXPECT_TRUE(document["rows"][1].contains(key)) << key;
    }
    EXPECT_EQ(document["rows"][1]["error_percent"], -3.0);
    EXPECT_EQ(document["rows"][1]["sim_rays_per_second"], 10000.0);
    EXPECT_THAT(validate_csv(report), testing::StartsWith("scene,workload,config,rays,hits,rtl_cycles,"));
    ASSERT_EQ(validate_charts(report).size(), 1U);
    EXPECT_TRUE(validate_charts({}).empty());
}

TEST(ValidateConfigs, AreManyAndDiffer) {
    const std::vector<ValidateConfig> configs = validate_configs();
    EXPECT_GE(configs.size(), 12U);
    EXPECT_TRUE(configs.front().sets.empty());
    for (std::size_t i = 0; i < configs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(configs[i].sets, configs[k].sets);
        EXPECT_EQ(configs[i].config.bvh.max_leaf_pairs, 1U);
        EXPECT_EQ(configs[i].config.rtu.count, 1U);
    }
}

}  // namespace
}  // namespace rtu::study
