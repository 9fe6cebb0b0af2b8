#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/methods/early_exits.hpp"
#include "model/methods/method.hpp"
#include "model/random.hpp"
#include "model/vec3.hpp"
#include "tests/model/random_points.hpp"

namespace rtu::model::methods {
namespace {

struct TriangleCase {
    Ray ray;
    Corners triangle;
};

// A ray between two points of the unit cube and a triangle in it, of which a good part is hit.
TriangleCase random_case(std::uint32_t index) {
    RandomStream random(7, 0, index);
    const Corners triangle{random_point(random), random_point(random), random_point(random)};
    const Vec3 origin = random_point(random);
    const float s = random.next(), r = random.next();
    const float u = 1.5F * s - 0.25F, v = 1.5F * r - 0.25F;
    const Vec3 aim = triangle[0] * (1 - u - v) + triangle[1] * u + triangle[2] * v;
    return {{origin, 0, aim - origin, infinity}, triangle};
}

// Far from every edge and not grazing, so that no method's rounding can decide otherwise.
bool is_clear(const TriangleCase& c) {
    const Vec3 ab = c.triangle[1] - c.triangle[0], ac = c.triangle[2] - c.triangle[0];
    const Vec3 n = cross(ab, ac);
    if (length(n) < 0.01F || std::abs(dot(normalized(n), normalized(c.ray.direction))) < 0.05F) return false;
    const Vec3 s = c.ray.origin - c.triangle[0];
    const float det = -dot(c.ray.direction, n);
    const float t = dot(s, n) / det;
    const float u = dot(cross(ac, s), c.ray.direction) / det;
    const float v = dot(cross(s, ab), c.ray.direction) / det;
    const auto is_off = [](float x) { return std::abs(x) > 0.01F; };
    return is_off(t) && is_off(u) && is_off(v) && is_off(1 - u - v);
}

class EveryMethod : public testing::TestWithParam<Contraction> {};

TEST_P(EveryMethod, AgreesWithTheExactTestAwayFromEdges) {
    const Method& exact = *find_method("exact");
    for (const Method& method : all_methods(GetParam())) {
        int hits = 0, misses = 0;
        for (std::uint32_t i = 0; i < 4000; ++i) {
            const TriangleCase c = random_case(i);
            if (!is_clear(c)) continue;
            const auto expected = exact.test(c.ray, c.triangle);
            if (method.info.is_one_sided &&
                dot(c.ray.direction, cross(c.triangle[1] - c.triangle[0], c.triangle[2] - c.triangle[0])) > 0)
                continue;
            const auto got = method.test(c.ray, c.triangle);
            ASSERT_EQ(got.has_value(), expected.has_value()) << method.info.name << " on case " << i;
            expected ? ++hits : ++misses;
            if (!expected) continue;
            EXPECT_NEAR(got->t, expected->t, 1e-3F * expected->t) << method.info.name << " on case " << i;
            EXPECT_NEAR(got->u, expected->u, 2e-3F) << method.info.name << " on case " << i;
            EXPECT_NEAR(got->v, expected->v, 2e-3F) << method.info.name << " on case " << i;
        }
        EXPECT_GT(hits, 300) << method.info.name;
        EXPECT_GT(misses, 300) << method.info.name;
    }
}

TEST_P(EveryMethod, CountsHitsInTheOpenIntervalOnly) {
    const Corners triangle{Vec3{-1, -1, 0}, Vec3{3, -1, 0}, Vec3{-1, 3, 0}};
    for (const Method& method : all_methods(GetParam())) {
        const auto is_hit = [&](float t_min, float t_max) {
            return method.test({{0, 0, 2}, t_min, {0, 0, -1}, t_max}, triangle).has_value();
        };
        EXPECT_TRUE(is_hit(0, infinity)) << method.info.name;
        EXPECT_TRUE(is_hit(1.75F, 2.25F)) << method.info.name;
        EXPECT_FALSE(is_hit(2, infinity)) << method.info.name;
        EXPECT_FALSE(is_hit(0, 2)) << method.info.name;
        EXPECT_FALSE(is_hit(2.25F, 1.75F)) << method.info.name;
        EXPECT_FALSE(method.test({{0, 0, 2}, 0, {0, 0, 1}, infinity}, triangle)) << method.info.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Contractions, EveryMethod, testing::Values(Contraction::Off, Contraction::Fast),
                         [](const auto& contraction) {
                             return std::string(contraction.param == Contraction::Off ? "Off" : "Fast");
                         });

TEST(Methods, HaveNamesOfTheirOwnAndAreFoundByThem) {
    std::set<std::string_view> names;
    for (const Method& method : all_methods()) {
        EXPECT_TRUE(names.insert(method.info.name).second) << method.info.name;
        EXPECT_EQ(find_method(method.info.name), &method);
    }
    EXPECT_EQ(find_method("mollertrumbore"), nullptr);
}

TEST(HavelHeroutSse4, GivesWhatTheScalarFormGivesButForRounding) {
    const Method *sse4 = find_method("havel_herout_sse4"), *scalar = find_method("havel_herout");
    if (sse4 == nullptr) GTEST_SKIP() << "the processor has no SSE4.1";
    int hits = 0, differing = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const TriangleCase c = random_case(i);
        const auto got = sse4->test(c.ray, c.triangle), expected = scalar->test(c.ray, c.triangle);
        differing += int(got.has_value() != expected.has_value());
        if (!got || !expected || !is_clear(c)) continue;
        ++hits;
        EXPECT_NEAR(got->t, expected->t, 1e-4F * expected->t);
        EXPECT_NEAR(got->u, expected->u, 1e-4F);
        EXPECT_NEAR(got->v, expected->v, 1e-4F);
    }
    EXPECT_GT(hits, 300);
    EXPECT_LT(differing, 5);
}

TEST(EarlyExits, AreCountedForEitherHalfOfTheTest) {
    const Corners triangle{Vec3{-1, -1, 2}, Vec3{3, -1, 2}, Vec3{-1, 3, 2}};
    const Vec3 in{0, 0, 1}, out{5, 5, 1};
    const std::vector<Ray> rays{{{}, 0, in, infinity},  {{}, 0, in, 1},  {{}, 3, in, 9},
                                {{}, 0, out, infinity}, {{}, 0, out, 1}, {{}, 0, -in, infinity}};
    const std::vector<Corners> triangles(rays.size(), triangle);
    EXPECT_EQ(count_early_exits(rays, triangles), (EarlyExits{6, 1, 3, 1, 1}));
    EXPECT_THROW((void)count_early_exits(rays, {}), std::logic_error);
}

}  // namespace
}  // namespace rtu::model::methods
