#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/parallel.hpp"
#include "model/vec3.hpp"
#include "study/check.hpp"
#include "study/oracle/exact_oracle.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::study {
namespace {

using model::Hit;
using model::Ray;
using model::RayKind;
using test::Random;
using test::Vec3;

using model::infinity;

struct CheckedRun {
    model::TriangleMesh mesh = test::triangle_soup(400, 21, 0.2F);
    model::MemoryImage image = test::image_of(mesh);
    model::Workload workload{"test", RayKind::ClosestHit, {}, {}};
    std::vector<std::optional<Hit>> hits;
    model::TraversalCounts counts;

    explicit CheckedRun(RayKind kind = RayKind::ClosestHit) {
        workload.ray_kind = kind;
        Random random(22);
        for (int i = 0; i < 500; ++i) {
            const Vec3 from = random.point(-1, 2), to = random.point(0, 1);
            workload.rays.push_back({from, 0, to - from, infinity});
            hits.push_back(model::trace(image, workload.rays.back(), kind, &counts));
        }
    }
    [[nodiscard]] CheckReport check() const {
        HitChecker checker(mesh, image);
        EXPECT_EQ(checker.check(workload, hits), counts);
        return checker.report();
    }
    [[nodiscard]] std::size_t first_hit() const {
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i]) return i;
        }
        return hits.size();
    }
};

TEST(HitChecker, FindsNothingWrongWithRightHits) {
    for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
        const CheckReport report = CheckedRun(kind).check();
        EXPECT_TRUE(report.is_clean());
        EXPECT_EQ(report.compared, 500U);
        EXPECT_EQ(report.embree_compared, 500U);
    }
}

TEST(HitChecker, SeesOneUnitInTheLastPlace) {
    CheckedRun run;
    Hit& hit = *run.hits[run.first_hit()];
    hit.t = std::nextafter(hit.t, 0.0F);
    EXPECT_EQ(run.check().mismatches, 1U);
}

TEST(HitChecker, SeesALostHit) {
    for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
        CheckedRun run(kind);
        run.hits[run.first_hit()].reset();
        const CheckReport report = run.check();
        EXPECT_EQ(report.mismatches, 1U);
        EXPECT_EQ(report.embree_mismatches, 1U);
        EXPECT_FALSE(report.is_clean());
    }
}

TEST(HitChecker, SeesAnInventedHit) {
    CheckedRun run;
    const auto miss = std::find(run.hits.begin(), run.hits.end(), std::nullopt);
    ASSERT_NE(miss, run.hits.end());
    *miss = Hit{1, 0, 0, 7};
    const CheckReport report = run.check();
    EXPECT_EQ(report.mismatches, 1U);
    EXPECT_EQ(report.embree_mismatches, 1U);
}

TEST(HitChecker, SeesAHitOnTheWrongTriangle) {
    CheckedRun run;
    Hit& hit = *run.hits[run.first_hit()];
    hit.primitive_id ^= 1U;
    hit.t *= 1.5F;
    const CheckReport report = run.check();
    EXPECT_EQ(report.mismatches, 1U);
    EXPECT_EQ(report.embree_mismatches, 1U);
}

// A unit square of two triangles in z = 0, and rays down on it.
const model::TriangleMesh square{
    "square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

Ray down(float x, float y) { return {{x, y, 1}, 0, {0, 0, -1}, infinity}; }

TEST(ExactHits, TellInsideEdgeAndOutsideApart) {
    const ExactHits inside = exact_hits(square, down(0.75F, 0.25F));
    EXPECT_EQ(inside.nearest, std::vector<std::uint32_t>{0});
    EXPECT_TRUE(inside.has_interior_hit);
    EXPECT_TRUE(inside.allows_closest(0));
    EXPECT_FALSE(inside.allows_closest(1));
    EXPECT_FALSE(inside.allows_closest(std::nullopt));

    const ExactHits diagonal = exact_hits(square, down(0.5F, 0.5F));
    EXPECT_EQ(diagonal.nearest, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_TRUE(diagonal.allows_closest(0));
    EXPECT_TRUE(diagonal.allows_closest(1));

    const ExactHits border = exact_hits(square, down(0.5F, 0.0F));
    EXPECT_TRUE(border.allows_closest(0));
    EXPECT_TRUE(border.allows_closest(std::nullopt));

    const ExactHits outside = exact_hits(square, down(0.5F, std::nextafter(0.0F, -1.0F)));
    EXPECT_TRUE(outside.nearest.empty());
    EXPECT_TRUE(outside.allows_any(false));
    EXPECT_FALSE(outside.allows_any(true));
}

TEST(ExactHits, RespectTheOpenInterval) {
    Ray ray = down(0.75F, 0.25F);
    ray.t_max = 1;
    EXPECT_TRUE(exact_hits(square, ray).nearest.empty());
    ray.t_max = std::nextafter(1.0F, 2.0F);
    EXPECT_EQ(exact_hits(square, ray).nearest.size(), 1U);
    ray.t_min = 1;
    EXPECT_TRUE(exact_hits(square, ray).nearest.empty());
}

// Three independent answers, away from edges: rational arithmetic, Embree, and the traversal.
TEST(EmbreeOracle, AgreesWithExactArithmetic) {
    const CheckedRun run;
    const EmbreeOracle embree(run.mesh);
    int hits = 0;
    for (std::size_t i = 0; i < run.hits.size(); ++i) {
        const ExactHits exact = exact_hits(run.mesh, run.workload.rays[i]);
        const auto other = embree.trace(run.workload.rays[i], RayKind::ClosestHit);
        EXPECT_TRUE(exact.allows_closest(other ? std::optional(other->primitive_id) : std::nullopt));
        EXPECT_TRUE(
            exact.allows_closest(run.hits[i] ? std::optional(run.hits[i]->primitive_id) : std::nullopt));
        hits += other ? 1 : 0;
    }
    EXPECT_GT(hits, 250);
}

// Embree builds its scenes with denormals flushed to zero, and oneTBB's loops would take that over.
TEST(EmbreeOracle, LeavesDenormalsToTheLoopsThatFollow) {
    const EmbreeOracle first_to_use_the_library(test::triangle_soup(10, 1));
    std::vector<float> numbers(100'000, std::numeric_limits<float>::min());
    model::for_each_range<std::size_t>(numbers.size(), 1, [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) numbers[i] *= 0.5F;
    });
    EXPECT_EQ(std::ranges::count(numbers, std::numeric_limits<float>::min() / 2), 100'000);
}

}  // namespace
}  // namespace rtu::study
