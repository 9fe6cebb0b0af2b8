#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/parallel.hpp"
#include "study/check.hpp"
#include "study/exact_oracle.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::study {
namespace {

using model::Hit;
using model::Ray;
using model::RayKind;
using test::Random;
using test::Vec3;

constexpr float infinity = std::numeric_limits<float>::infinity();

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
    EXPECT_EQ(report.neighbours, 0U);
}

// A hit swapped for the one across a common edge counts as a neighbour only when the ray passes that edge
// closely enough.
TEST(HitChecker, CallsOnlyWhatBinary32CannotTellANeighbour) {
    const model::TriangleMesh mesh{
        "square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const model::MemoryImage image = test::image_of(mesh);
    const auto check = [&](float offset) {
        const model::Workload workload{
            "one", RayKind::ClosestHit, {{{0.5F, 0.5F - offset, 1}, 0, {0, 0, -1}, infinity}}, {}};
        HitChecker checker(mesh, image);
        const std::vector<std::optional<Hit>> wrong{Hit{1, 0.5F, 0.5F, 1}};
        (void)checker.check(workload, wrong);
        return checker.report();
    };
    EXPECT_EQ(check(0x1p-22F).neighbours, 1U);
    EXPECT_EQ(check(0x1p-22F).embree_mismatches, 1U);  // explained, not excused
    // The same depth, but well inside the other triangle.
    EXPECT_EQ(check(0.25F).neighbours, 0U);
    EXPECT_EQ(check(0.25F).embree_mismatches, 1U);
    // A lost hit has no depth to compare: only the edge counts.
    const auto lose = [&](float offset) {
        const model::Workload workload{
            "one", RayKind::ClosestHit, {{{0.5F, offset, 1}, 0, {0, 0, -1}, infinity}}, {}};
        HitChecker checker(mesh, image);
        (void)checker.check(workload, std::vector<std::optional<Hit>>(1));
        return checker.report();
    };
    EXPECT_EQ(lose(0x1p-22F).neighbours, 1U);
    EXPECT_EQ(lose(0x1p-18F).neighbours, 0U);
    EXPECT_EQ(lose(0x1p-18F).embree_mismatches, 1U);
}

// A unit square of two triangles in z = 0, and rays down on it.
const model::TriangleMesh square{
    "square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

Ray down(float x, float y) { return {{x, y, 1}, 0, {0, 0, -1}, infinity}; }

// A ray that runs down at x = y, `below` a half, past the slanted edge of a lone triangle or the common edge
// of a square over a floor; `claimed` is what the machine is said to have hit.
CheckReport check_beside_edge(bool has_square, float below, std::optional<std::uint32_t> claimed) {
    const model::TriangleMesh mesh{
        "edge",
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {-5, -5, -1}, {9, -5, -1}, {-5, 9, -1}},
        {{0, 1, 2}, {4, 5, 6}, has_square ? model::Triangle{1, 3, 2} : model::Triangle{4, 5, 6}}};
    const model::MemoryImage image = test::image_of(mesh);
    model::Workload workload{"test", RayKind::ClosestHit, {}, {}};
    workload.rays.push_back({{0.5F - below, 0.5F - below, 1}, 0, {0, 0, -1}, infinity});
    std::optional<Hit> hit;
    if (claimed) hit = Hit{*claimed == 1 ? 2.0F : 1.0F, 0, 0, *claimed};
    HitChecker checker(mesh, image);
    static_cast<void>(checker.check(workload, std::vector{hit}));
    return checker.report();
}

TEST(HitChecker, ASilhouetteWithinRoundingIsANeighbour) {
    EXPECT_EQ(check_beside_edge(false, 0x1p-25F, 1).neighbours, 1U);
    EXPECT_EQ(check_beside_edge(false, 0x1p-25F, 1).embree_mismatches, 1U);
    for (const CheckReport& report :
         {check_beside_edge(false, 0x1p-18F, 1),                // too far inside
          check_beside_edge(false, 0x1p-25F, std::nullopt)}) {  // the floor is there
        EXPECT_EQ(report.embree_mismatches, 1U);
        EXPECT_EQ(report.neighbours, 0U);
    }
}

TEST(HitChecker, ALeakAtACommonEdgeIsNoNeighbour) {
    for (const float below : {0x1p-25F, 0x1p-24F, 0x1p-22F, 0x1p-18F}) {
        for (const CheckReport& report :
             {check_beside_edge(true, below, 1), check_beside_edge(true, below, std::nullopt)}) {
            EXPECT_EQ(report.embree_mismatches, 1U) << below;
            EXPECT_EQ(report.neighbours, 0U) << below;
        }
    }
    EXPECT_EQ(check_beside_edge(true, 0x1p-25F, 2).neighbours, 1U);  // the square's other half
}

TEST(ExactHits, SeeAShiftThatTheOriginCannotHold) {
    const model::TriangleMesh mesh{"far", {{1e7F, 0, 0}, {1e7F + 1, 0, 0}, {1e7F, 1, 0}}, {{0, 1, 2}}};
    const Ray along_edge{{1e7F, 0.25F, 1}, 0, {0, 0, -1}, infinity};
    EXPECT_FALSE(exact_hits(mesh, along_edge).has_interior_hit);
    EXPECT_TRUE(exact_hits(mesh, along_edge, {1e-9, 0, 0}).has_interior_hit);
    EXPECT_TRUE(exact_hits(mesh, along_edge, {-1e-9, 0, 0}).nearest.empty());
}

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

// Needles: their depth must not lose its digits, or secondary rays hit the surface that they leave.
TEST(ExactHits, BoundTheErrorOfDepthOnNeedles) {
    Random random(23);
    for (int i = 0; i < 2'000; ++i) {
        const float width = std::ldexp(1.0F, -int(random.below(12)) - 3);
        const Vec3 a = random.point(-4, 4), along = random.point(-4, 4), across = random.point(-1, 1) * width;
        const model::TriangleMesh needle{"needle", {a, a + along, a + across}, {{0, 1, 2}}};
        const auto& p = needle.positions;
        const Vec3 target = (p[0] + p[1] + p[2]) * (1.0F / 3.0F);
        const Vec3 origin = random.point(-4, 4);
        const auto image = test::image_of(needle, {}, {model::PairingKind::None, 0});
        const auto hit = model::trace(image, {origin, 0, target - origin, infinity}, RayKind::ClosestHit);
        if (!hit) continue;
        const Vec3 n = cross(p[1] - p[0], p[2] - p[0]), d = target - origin;
        const float sine = std::abs(dot(n, d)) / (length(n) * length(d));
        if (sine < 0.1F) continue;
        // The target is the centroid, so t = 1 but for the rounding of the centroid and of the sheared
        // vertices.
        EXPECT_NEAR(hit->t, 1.0F, 40 * 0x1p-24F * 8 / (sine * length(d)));
    }
}

}  // namespace
}  // namespace rtu::study
