#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "model/traversal.hpp"
#include "sim/config.hpp"
#include "study/methods/methods_leaf_mix.hpp"
#include "study/methods/methods_study.hpp"
#include "study/methods/methods_text.hpp"
#include "study/scene_steps.hpp"

namespace rtu::study {
namespace {

using model::methods::Form;
using model::methods::Kernel;

TEST(MethodsWorkload, HasPairsWithACommonEdgeInTheUnitCubeAndRaysWithinIt) {
    const MethodsWorkload workload = random_methods_workload(64, 16, 5);
    ASSERT_EQ(workload.triangles.size(), 64);
    ASSERT_EQ(workload.rays.size(), 16);
    for (std::size_t i = 0; i < 64; i += 2) {
        EXPECT_EQ(workload.triangles[i][0], workload.triangles[i + 1][0]);
        EXPECT_EQ(workload.triangles[i][2], workload.triangles[i + 1][1]);
        for (const model::Vec3 corner : workload.triangles[i])
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_GE(corner[axis], 0);
                EXPECT_LT(corner[axis], 1);
            }
    }
    EXPECT_EQ(random_methods_workload(64, 16, 5).rays, workload.rays);
    EXPECT_NE(random_methods_workload(64, 16, 6).rays, workload.rays);
}

struct Scene {
    LoadedScene loaded = load_scene({});
    BuiltScene built = build_scene(loaded.mesh, {model::PairingKind::EdgeBbsa}, model::EdgeIdentity::Position,
                                   sim::Config{}.bvh);
    model::Workload workload =
        make_workload(model::WorkloadKind::Diffuse, loaded.mesh, built.image,
                      choose_camera(loaded.mesh, built.image, {}, std::nullopt).camera, {64, 64}, 1);
};

model::methods::RayResult nearest(const Kernel& kernel, const RayLeaves& leaves) {
    model::methods::PreparedTriangles prepared;
    kernel.store(leaves.triangles, prepared);
    model::methods::RayResult result;
    kernel.trace(prepared, {&leaves.ray, 1}, true, {&result, 1});
    return result;
}

const Kernel& exact_kernel(Form form) {
    const auto& kernels = model::methods::all_kernels();
    return *std::ranges::find_if(
        kernels, [&](const Kernel& kernel) { return kernel.method.name == "exact" && kernel.form == form; });
}

// The machine's test on what the traversal visited must find what the traversal found.
TEST(LeafMix, HoldsTheTrianglesThatTheTraversalTests) {
    const Scene scene;
    const auto mix = leaf_mix(scene.loaded.mesh, scene.built.image, scene.workload, 200, 1);
    ASSERT_GT(mix.size(), 100);
    int hits = 0;
    for (const RayLeaves& leaves : mix) {
        model::TraversalCounts counts;
        const auto hit = trace(scene.built.image, leaves.ray, scene.workload.ray_kind, &counts);
        const auto result = nearest(exact_kernel(Form::Single), leaves);
        EXPECT_EQ(leaves.triangles.size(), counts.triangle_tests);
        ASSERT_EQ(result.hit_count > 0, hit.has_value());
        if (!hit) continue;
        EXPECT_EQ(result.nearest.t, hit->t);
        ++hits;
    }
    EXPECT_GT(hits, 50);
}

TEST(LeafMix, TakesWholePairsOnly) {
    const Scene scene;
    const auto mix = pair_mix(scene.built.image, scene.workload, 200, 1);
    ASSERT_GT(mix.size(), 100);
    for (const RayLeaves& leaves : mix) {
        ASSERT_EQ(leaves.triangles.size() % 2, 0);
        for (std::size_t i = 0; i < leaves.triangles.size(); i += 2) {
            EXPECT_EQ(leaves.triangles[i][0], leaves.triangles[i + 1][0]);
            EXPECT_EQ(leaves.triangles[i][2], leaves.triangles[i + 1][1]);
        }
    }
}

TEST(LeafMix, SamplesAllOverThePicture) {
    const Scene scene;
    const auto mix = leaf_mix(scene.loaded.mesh, scene.built.image, scene.workload, 64, 1);
    const auto again = leaf_mix(scene.loaded.mesh, scene.built.image, scene.workload, 64, 1);
    ASSERT_EQ(mix.size(), again.size());
    for (std::size_t i = 0; i < mix.size(); ++i) EXPECT_EQ(mix[i].ray, again[i].ray);
    EXPECT_LE(mix.size(), 64);
}

MethodsReport small_study() {
    MethodsOptions options;
    options.methods = {"wald", "moller_trumbore"};
    options.forms = {Form::Single, Form::Triangles};
    options.triangle_count = 32;
    options.ray_count = 8;
    options.repeats = 2;
    options.scenes = {SceneSource{}};
    options.workloads = {model::WorkloadKind::Primary};
    return run_methods_study(options);
}

TEST(MethodsStudy, MeasuresWhatWasAskedForAndNothingElse) {
    const MethodsReport report = small_study();
    EXPECT_GT(report.clock_hz, 1e8);
    for (const MethodsRow& row : report.rows) {
        EXPECT_THAT(row.kernel.method.name, testing::AnyOf("wald", "moller_trumbore"));
        EXPECT_THAT(row.kernel.form, testing::AnyOf(Form::Single, Form::Triangles));
        EXPECT_GT(row.tests_per_second, 1e4);
        EXPECT_TRUE(std::isfinite(row.tests_per_second));
        EXPECT_THAT(row.workload, testing::AnyOf("random", "builtin/primary"));
        if (row.workload == "random") {
            EXPECT_EQ(row.tests, 32 * 8);
        }
    }
    EXPECT_EQ(report.scaling.size(), 5);
    EXPECT_EQ(report.scaling.front().tests, 1 << 14);
    EXPECT_EQ(report.scaling.back().tests, 1 << 22);
}

TEST(MethodsStudy, WritesTheSameRowsAsJsonAndCsv) {
    const MethodsReport report = small_study();
    const auto json = nlohmann::json::parse(methods_json(report));
    ASSERT_EQ(json["rows"].size(), report.rows.size());
    for (const char* key : {"method", "form", "width", "mtests_per_second", "worst_mtests_per_second",
                            "precompute_mtriangles_per_second", "cycles_per_test"})
        EXPECT_TRUE(json["rows"][0].contains(key)) << key;
    for (const auto& row : json["rows"])
        if (row["method"] == "wald") {
            EXPECT_EQ(row["ratio_to_wald"], 1.0);
        }
    const std::string csv = methods_csv(report);
    EXPECT_EQ(std::ranges::count(csv, '\n'), std::ptrdiff_t(report.rows.size()) + 1);
    EXPECT_THAT(methods_text(report), testing::HasSubstr("Each ray on the triangles of the leaves"));
}

TEST(MethodsStudy, NamesTheKnownMethodsWhenOneIsUnknown) {
    EXPECT_THAT([] { check_method_name("mt"); },
                testing::ThrowsMessage<std::exception>(
                    testing::AllOf(testing::HasSubstr("moller_trumbore, "), testing::HasSubstr("got 'mt'"))));
    EXPECT_THAT(
        [] { static_cast<void>(parse_form("packet")); },
        testing::ThrowsMessage<std::exception>(testing::HasSubstr("single, rays, triangles or pairs")));
}

}  // namespace
}  // namespace rtu::study
