#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/methods/exact.hpp"
#include "model/methods/quantised_filter.hpp"
#include "tests/model/meshes.hpp"
#include "tests/model/method_cases.hpp"

namespace rtu::model::methods {
namespace {

class Filter : public testing::TestWithParam<NumberFormat> {};

// Rays at edges, vertices and anywhere, of all scales; nothing that is hit is thrown out.
TEST_P(Filter, LosesNoHit) {
    test::MethodCases cases(5);
    int hits = 0;
    for (int i = 0; i < 40'000; ++i) {
        const test::MethodCase c = cases.next();
        if (!test_exactly(c.ray, c.triangle)) continue;
        ++hits;
        ASSERT_TRUE(QuantisedFilter(c.ray, GetParam()).may_hit(c.triangle)) << i;
    }
    EXPECT_GT(hits, 5000);
}

TEST_P(Filter, LosesNoHitAtTheEdgesOfAMeshFarAway) {
    const TriangleMesh mesh = test::closed_sphere(6, {1000, -2000, 300}, 2);
    test::Random random(9);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 origin = Vec3{1000, -2000, 300} + random.point(-0.5F, 0.5F);
        const auto& aimed = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
        const float s = i % 2 == 0 ? random.uniform(0, 1) : 0.0F;
        const Vec3 a = mesh.positions[aimed[0]], b = mesh.positions[aimed[1]];
        const Ray ray{origin, 0, a + (b - a) * s - origin, std::numeric_limits<float>::infinity()};
        const QuantisedFilter filter(ray, GetParam());
        for (const auto& t : mesh.triangles) {
            const Corners corners{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
            if (!test_exactly(ray, corners)) continue;
            ++hits;
            ASSERT_TRUE(filter.may_hit(corners)) << i;
        }
    }
    EXPECT_EQ(hits, 300);
}

INSTANTIATE_TEST_SUITE_P(Formats, Filter,
                         testing::Values(NumberFormat{8, 2}, NumberFormat{8, 4}, NumberFormat{8, 7},
                                         NumberFormat{8, 12}, NumberFormat{8, 23}, NumberFormat{5, 10}),
                         [](const auto& format) { return to_string(format.param); });

// Rays through the unit cube, triangles in it: the share of misses that each format passes on.
TEST(QuantisedFilter, PassesFewerMissesWithEveryBit) {
    test::Random random(1);
    std::array<int, 4> passed{};
    constexpr std::array<std::uint8_t, 4> bits{2, 4, 8, 16};
    int misses = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Corners triangle{random.point(0, 1), random.point(0, 1), random.point(0, 1)};
        const Vec3 origin = random.point(0, 1);
        const Ray ray{origin, 0, random.point(0, 1) - origin, 1};
        if (test_exactly(ray, triangle)) continue;
        ++misses;
        for (std::size_t k = 0; k < bits.size(); ++k) {
            passed[k] += QuantisedFilter(ray, {8, bits[k]}).may_hit(triangle) ? 1 : 0;
        }
    }
    EXPECT_GT(passed[0], 2 * passed[1]);
    EXPECT_GT(passed[1], passed[2]);
    EXPECT_GT(passed[2], passed[3]);
    EXPECT_LT(passed[1], misses / 4);
}

TEST(QuantisedFilter, ThrowsOutWhatIsBehindOrBeyond) {
    const Corners triangle{Vec3{-1, -1, 2}, Vec3{1, -1, 2}, Vec3{0, 1, 2}};
    const auto may_hit = [&](float t_min, float direction, float t_max) {
        return QuantisedFilter({{0, 0, 0}, t_min, {0, 0, direction}, t_max}, {8, 4}).may_hit(triangle);
    };
    EXPECT_TRUE(may_hit(0, 1, 3));
    EXPECT_TRUE(may_hit(0, 1, std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(may_hit(0, -1, std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(may_hit(0, 1, 1));
    EXPECT_FALSE(may_hit(3, 1, 9));
    EXPECT_TRUE(may_hit(-3, -1, 0));
}

}  // namespace
}  // namespace rtu::model::methods
