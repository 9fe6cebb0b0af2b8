#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/error.hpp"
#include "model/workload.hpp"
#include "study/pairing/pairing_rotation.hpp"
#include "study/pairing/pairing_study.hpp"
#include "study/scene_run.hpp"
#include "study/scene_steps.hpp"

namespace rtu::study {
namespace {

using model::PairingKind;
using model::WorkloadKind;
using testing::ElementsAre;
using testing::HasSubstr;

PairingOptions small_options() {
    PairingOptions options;
    options.methods = {{PairingKind::EdgeBbsa, 0}};
    options.workloads = {WorkloadKind::Primary, WorkloadKind::Shadow, WorkloadKind::Diffuse};
    options.resolution = {24, 24};
    options.seed = 5;
    options.machine = sim::default_config();
    return options;
}

TEST(Rotation, IsExactAtQuarterTurns) {
    const auto turned = [](RotationDegrees degrees, model::Vec3 p) {
        return model::transform(rotation(degrees), p);
    };
    EXPECT_EQ(turned({90, 0, 0}, {0, 1, 0}), (model::Vec3{0, 0, 1}));  // y to z
    EXPECT_EQ(turned({0, 90, 0}, {0, 0, 1}), (model::Vec3{1, 0, 0}));  // z to x
    EXPECT_EQ(turned({0, 0, 90}, {1, 0, 0}), (model::Vec3{0, 1, 0}));  // x to y
    EXPECT_EQ(turned({0, 0, -270}, {1, 2, 3}), turned({0, 0, 90}, {1, 2, 3}));
    EXPECT_EQ(turned({360, -360, 180}, {1, 2, 3}), (model::Vec3{-1, -2, 3}));
    EXPECT_EQ(turned({90, 90, 0}, {0, 1, 0}), (model::Vec3{1, 0, 0}));  // x first, then y
}

TEST(Rotation, AgreesWithTrigonometry) {
    for (const double degrees : {-359.0, -100.5, 1e-9, 30.0, 44.999, 45.0, 45.001, 135.0, 300.0}) {
        const model::Affine map = rotation({0, 0, degrees});
        const double radians = degrees * std::acos(-1.0) / 180;
        EXPECT_NEAR(map.rows[0][0], std::cos(radians), 1e-15) << degrees;
        EXPECT_NEAR(map.rows[1][0], std::sin(radians), 1e-15) << degrees;
    }
}

TEST(Rotation, KeepsThePictureAndTheWindowsPairs) {
    const PairingOptions options = small_options();
    const SceneSource builtin;
    PairingBench bench(options, builtin);
    const PairingSetting plain{options.machine.config, {}, {WorkloadKind::Primary}};
    const PairingSetting turned{options.machine.config, {20, 35, -50}, {WorkloadKind::Primary}};
    for (const model::PairingMethod method : {options.baseline, options.methods.front()}) {
        const PairingRun before = bench.run(method, plain), after = bench.run(method, turned);
        EXPECT_EQ(before.total.ray_count, after.total.ray_count);
        EXPECT_NEAR(double(before.total.hit_count), double(after.total.hit_count), 2);
        EXPECT_NE(before.total.box_tests, after.total.box_tests);
        if (method.kind == PairingKind::Window) {
            EXPECT_EQ(before.pairing.paired_percent, after.pairing.paired_percent);
        }
    }
}

TEST(Rotation, RefusesToLeaveTheCoordinatesThatCanBeTraced) {
    model::TriangleMesh mesh;
    mesh.name = "far";
    mesh.positions = {{model::max_coordinate, model::max_coordinate, 0}};
    EXPECT_NO_THROW((void)rotated(mesh, rotation({0, 0, 90})));
    EXPECT_THROW((void)rotated(mesh, rotation({0, 0, 45})), Error);
}

TEST(PairingBench, MeasuresWhatARunReports) {
    PairingOptions options = small_options();
    RunOptions run;
    run.workloads = options.workloads;
    run.resolution = options.resolution;
    run.seed = options.seed;
    const SceneSource builtin;
    PairingBench bench(options, builtin);
    const PairingSetting setting{options.machine.config, {}, options.workloads};
    for (const model::PairingMethod method : {options.methods.front(), options.baseline}) {
        run.pairing = method;
        const SceneReport expected = run_scene(run, builtin);
        const PairingRun measured = bench.run(method, setting);
        EXPECT_EQ(measured.pairing.paired_percent, expected.pairing.paired_percent);
        EXPECT_EQ(measured.bvh.image_bytes, expected.bvh.image_bytes);
        EXPECT_EQ(measured.total.hit_count, total(expected).hit_count);
        EXPECT_EQ(measured.total.box_tests, total(expected).box_tests);
        EXPECT_EQ(measured.total.pair_tests, total(expected).pair_tests);
        EXPECT_EQ(measured.total.cycles, total(expected).cycles);
        EXPECT_EQ(bench.scene().input_hash, expected.input_hash);
    }
}

TEST(PairingBench, SimulatesNothingTwice) {
    PairingOptions options = small_options();
    int simulations = 0, loads = 0;
    options.progress = [&](std::string_view phase) {
        simulations += phase.find(": 0 %") != std::string_view::npos ? 1 : 0;
        loads += phase == "loading" ? 1 : 0;
    };
    options.resolution = {8, 8};
    options.studies = {PairingStudyKind::Testers, PairingStudyKind::RayKind};
    const std::vector<SceneSource> scenes(1);
    int phases = 0;
    const auto count = options.progress;
    options.progress = [&](std::string_view phase) {
        phases += phase.find("making rays") != std::string_view::npos ? 1 : 0;
        count(phase);
    };
    const PairingReport report = run_pairing_studies(options, scenes);
    EXPECT_EQ(loads, 1);
    EXPECT_EQ(phases, 5);  // each of the five kinds of ray once, whatever the pairings
    // dual_shared is the default machine, and three kinds of ray are in the comparison already.
    EXPECT_EQ(report.studies[0].points[2].row.after.total.cycles, report.rows[0].after.total.cycles);
}

TEST(PairingStudy, PointsAreThoseOfItsAxis) {
    PairingOptions options = small_options();
    options.rotation = {10, 0, 0};
    options.presets = {{"default", options.machine}};
    const auto settings = [&](PairingStudyKind kind) {
        std::vector<std::string> names;
        for (const StudyPoint& point : study_points(kind, options, {})) names.push_back(point.setting);
        return names;
    };
    using enum PairingStudyKind;
    EXPECT_THAT(settings(Window), ElementsAre("2", "4", "8", "16", "32", "64", "-"));
    EXPECT_THAT(settings(Rotation),
                ElementsAre("0 deg", "15 deg", "30 deg", "45 deg", "60 deg", "75 deg", "90 deg"));
    EXPECT_THAT(settings(RayKind), ElementsAre("primary", "shadow", "ao", "diffuse", "random"));
    EXPECT_THAT(settings(Preset), ElementsAre("default"));
    EXPECT_THAT(settings(L1Size),
                ElementsAre("8 KiB", "16 KiB", "32 KiB", "64 KiB", "128 KiB", "256 KiB", "512 KiB"));
    EXPECT_THAT(settings(L2Size),
                ElementsAre("0.5 MiB", "1 MiB", "2 MiB", "4 MiB", "8 MiB", "16 MiB", "32 MiB", "64 MiB"));
    EXPECT_EQ(settings(DramBandwidth).front(), "8.0 GB/s");
    EXPECT_THAT(settings(Testers), ElementsAre("single", "dual_independent", "dual_shared"));
    EXPECT_THAT(study_points(Rotation, options, {})[3].under.rotation, ElementsAre(10, 45, 0));
    const model::Camera z_up{{}, {}, {0, 0.1F, 1}, 1};
    EXPECT_THAT(study_points(Rotation, options, z_up)[3].under.rotation, ElementsAre(10, 0, 45));
}

TEST(PairingStudy, LeavesOutSizesThatTheMachineDoesNotAllow) {
    PairingOptions options = small_options();
    const std::vector<std::string> sets{"l1.mshrs=256"};  // 256 lines of 128 bytes are 32 KiB
    options.machine = sim::load_config("default", {}, sets);
    EXPECT_EQ(study_points(PairingStudyKind::L1Size, options, {}).front().setting, "32 KiB");
    options.machine = sim::load_config("default", {}, std::vector<std::string>{"dram.bytes_per_cycle=2"});
    const auto points = study_points(PairingStudyKind::DramBandwidth, options, {});
    EXPECT_EQ(points.front().under.config.dram.bytes_per_cycle, 1U);
    EXPECT_EQ(points[1].under.config.dram.bytes_per_cycle, 2U);  // no point twice
}

TEST(PairingStudy, RefusesToVaryWhatAFlatMemoryDoesNotHave) {
    PairingOptions options = small_options();
    options.machine = sim::load_config("default", {}, std::vector<std::string>{"memory.model=flat"});
    EXPECT_THROW((void)study_points(PairingStudyKind::L2Size, options, {}), Error);
    EXPECT_THROW((void)study_points(PairingStudyKind::DramBandwidth, options, {}), Error);
    EXPECT_FALSE(study_points(PairingStudyKind::L1Size, options, {}).empty());
}

TEST(PairingStudy, UnknownNameListsTheKnownOnes) {
    try {
        (void)parse_pairing_study("colour");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("colour"));
        for (const PairingStudyInfo& study : pairing_studies()) {
            EXPECT_THAT(error.what(), HasSubstr(std::string(study.name)));
            EXPECT_EQ(&info(parse_pairing_study(study.name)), &study);
        }
    }
}

}  // namespace
}  // namespace rtu::study
