#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/methods/emulated.hpp"
#include "study/precision/precision_area.hpp"
#include "study/precision/precision_ladder.hpp"
#include "study/precision/precision_output.hpp"
#include "study/precision/precision_tables.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::study {
namespace {

using model::methods::NumberFormat;
using testing::HasSubstr;

// A ball seen from inside, a little off its centre.
PrecisionRays ball_rays(std::uint32_t count) {
    const model::TriangleMesh mesh = test::closed_sphere(6, {0, 0, 0}, 2);
    const model::MemoryImage image = test::image_of(mesh);
    model::Workload workload{"random", model::RayKind::ClosestHit, {}, {}};
    test::Random random(4);
    for (std::uint32_t i = 0; i < count; ++i) {
        workload.rays.push_back({random.point(-0.4F, 0.4F), 0, random.point(-1, 1), 100});
    }
    return {sampled_rays(mesh, image, workload, count, 1), aimed_rays(mesh, image, workload, count, 1)};
}

const PrecisionRow& row_of(const std::vector<PrecisionRow>& rows, std::string_view method,
                           NumberFormat format) {
    for (const PrecisionRow& row : rows) {
        if (row.method == method && row.format == format) return row;
    }
    throw std::logic_error("no such row");
}

PrecisionOptions few_methods() {
    PrecisionOptions options;
    options.methods = {"moller_trumbore", "woop_top_left"};
    return options;
}

TEST(PrecisionRows, Binary32IsEnoughForABallAndBfloat16IsNot) {
    const PrecisionRays rays = ball_rays(1500);
    ASSERT_EQ(rays.sampled.size(), 1500U);
    ASSERT_GT(rays.aimed.size(), 1000U);
    PrecisionOptions options = few_methods();
    options.wrong_per_million = 3000;
    const auto rows = precision_rows("ball", rays, options);
    ASSERT_EQ(rows.size(), 3 * ladder_formats().size());
    for (const char* method : {"moller_trumbore", "woop_top_left", "exact"}) {
        const PrecisionRow &wide = row_of(rows, method, {8, 23}), &narrow = row_of(rows, method, {8, 7});
        EXPECT_EQ(wide.wrong(), 0U) << method;
        EXPECT_TRUE(wide.is_enough) << method;
        EXPECT_FALSE(narrow.is_enough) << method;
        EXPECT_GT(narrow.wrong(), 100U) << method;
        EXPECT_GT(narrow.t_ulp_p50, 1000 * wide.t_ulp_p50.value()) << method;
        EXPECT_EQ(wide.aimed_rays, rays.aimed.size()) << method;
    }
    const PrecisionRow& leaky = row_of(rows, "moller_trumbore", {8, 23});
    const PrecisionRow& tight = row_of(rows, "woop_top_left", {8, 23});
    const PrecisionRow& exact = row_of(rows, "exact", {8, 23});
    EXPECT_GT(leaky.leaks, 0U);
    EXPECT_GT(leaky.doubles, 0U);
    EXPECT_EQ(tight.leaks + tight.doubles, 0U);
    EXPECT_EQ(exact.leaks + exact.doubles + exact.false_hits + exact.false_misses, 0U);
    EXPECT_EQ(tight.triangle_bits, 9 * 32U);
    EXPECT_FALSE(exact.area);
}

TEST(PrecisionRows, DoNotDependOnTheNumberOfThreads) {
    const PrecisionRays rays = ball_rays(200);
    PrecisionReport one, many;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        one.rows = precision_rows("ball", rays, few_methods());
    }
    many.rows = precision_rows("ball", rays, few_methods());
    EXPECT_EQ(precision_csv(one), precision_csv(many));
}

TEST(FilterRows, LoseNoHitAndPassLessWithEveryBit) {
    const PrecisionRays rays = ball_rays(300);
    const std::vector<FilterRow> rows = filter_rows("ball", rays.sampled);
    ASSERT_EQ(rows.size(), 12U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].false_negatives, 0U) << i;
        EXPECT_EQ(rows[i].hits, rows[0].hits);
        if (i > 0) {
            EXPECT_LE(rows[i].passed, rows[i - 1].passed) << i;
            EXPECT_GT(rows[i].area, rows[i - 1].area) << i;
        }
    }
    EXPECT_GT(rows.front().false_positive_percent(), 2 * rows.back().false_positive_percent());
}

TEST(PrecisionReport, BoundsARateByWhatWasSeen) {
    EXPECT_NEAR(upper_rate_per_million(0, 1000), 2995.7, 0.1);  // -ln 0.05 of a thousand
    EXPECT_NEAR(upper_rate_per_million(3, 8000), 7.754 / 8000 * 1e6, 0.1);
    EXPECT_NEAR(upper_rate_per_million(10, 1'000'000), 16.962, 0.001);
    EXPECT_NEAR(upper_rate_per_million(401, 1'000'000), 436, 2);
    EXPECT_EQ(upper_rate_per_million(1000, 1000), 1e6);
    EXPECT_EQ(upper_rate_per_million(0, 0), 1e6);
}

PrecisionReport example_precision() {
    PrecisionReport report;
    report.wrong_per_million = 1000;
    for (const int bits : {7, 8, 9, 23}) {
        PrecisionRow row;
        row.scene = "hall";
        row.method = "wald";
        row.format = {8, std::uint8_t(bits)};
        row.rays = row.tests = 100;
        row.aimed_rays = 10;
        row.leaks = 2;
        row.lost = bits == 23 ? 0 : std::uint64_t(24 - bits);
        row.is_enough = bits != 8;  // 7 is by chance
        row.area = bits;
        report.rows.push_back(row);
    }
    PrecisionAnswer answer;
    answer.scene = "hall";
    answer.rays = 100;
    answer.workloads = {"primary"};
    answer.row = 2;
    report.scenes.push_back(answer);
    return report;
}

TEST(PrecisionReport, TakesTheNarrowestFormatFromWhichAllWiderOnesAreEnough) {
    const PrecisionReport report = example_precision();
    const auto rungs = ladder(report, "hall", "wald", 8);
    ASSERT_EQ(rungs.size(), 4U);
    EXPECT_EQ(narrowest_enough(rungs), &report.rows[2]);
    EXPECT_EQ(narrowest_enough({&report.rows[1]}), nullptr);
    EXPECT_TRUE(ladder(report, "hall", "woop", 8).empty());
}

TEST(PrecisionReport, AnswersInWordsAndShowsTheEvidence) {
    const PrecisionReport report = example_precision();
    const std::string text = precision_text(report);
    for (const char* part : {"hall: wald in e8m9 (18 bits) is the cheapest", "15 of 100 rays (primary) wrong",
                             "39 % of the 23.0 in binary32", "With one bit less, 16 rays are wrong",
                             "Of 10 rays aimed at edges and vertices, 2 leak", "The ladder of wald"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    PrecisionReport none = report;
    none.scenes[0].row.reset();
    EXPECT_THAT(precision_text(none), HasSubstr("none of the methods and formats is exact enough"));
}

TEST(PrecisionReport, IsTheSameAsJson) {
    const auto document = nlohmann::json::parse(precision_json(example_precision()));
    EXPECT_EQ(document["answers"][0]["row"]["format"], "e8m9");
    EXPECT_TRUE(document["answers"][0]["watertight_row"].is_null());
    EXPECT_EQ(document["rows"].size(), 4U);
    EXPECT_EQ(document["rows"][0]["wrong_rays"], 17);
    EXPECT_TRUE(document["rows"][0]["t_ulp_p99"].is_null());
    EXPECT_THAT(precision_csv(example_precision()),
                testing::StartsWith("scene,method,format,exponent_bits,"));
}

TEST(AreaProxy, GrowsWithTheSquareForProductsAndLinearlyForSums) {
    EXPECT_DOUBLE_EQ(area_proxy(model::methods::OperationCounts{10, 0, 0, 5, 5, 0}, {8, 23}), 10);
    EXPECT_DOUBLE_EQ(area_proxy(model::methods::OperationCounts{10, 0, 0, 5, 5, 0}, {8, 11}), 2.5);
    EXPECT_DOUBLE_EQ(area_proxy(model::methods::OperationCounts{0, 10, 0, 0, 0, 9}, {8, 11}), 1.5);
    EXPECT_DOUBLE_EQ(area_proxy(model::methods::OperationCounts{0, 0, 1, 0, 0, 0}, {8, 23}), 8);
}

}  // namespace
}  // namespace rtu::study
