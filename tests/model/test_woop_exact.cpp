#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "model/methods/kernel.hpp"
#include "model/random.hpp"
#include "model/vec3.hpp"
#include "tests/model/random_points.hpp"

// A method that decides as the exact test does: held against it on rays that rounding makes hard.

namespace rtu::model::methods {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// Moves one coordinate by up to two units in the last place.
Vec3 nudged(Vec3 p, RandomStream& random) {
    float& x = p[std::size_t(random.next() * 3)];
    for (int steps = int(random.next() * 3); steps > 0; --steps)
        x = std::nextafter(x, random.next() < 0.5F ? -infinity : infinity);
    return p;
}

struct Case {
    Ray ray;
    Corners triangle;
};

// Rays at corners, along edges and beside them by ulps, at triangles of many sizes and places; some of a t
// range that begins or ends at the hit.
Case hard_case(std::uint32_t index) {
    RandomStream random(11, 3, index);
    const float size = std::exp2(std::floor(random.next() * 40) - 20);
    const float offset = index % 3 == 0 ? 0 : std::exp2(std::floor(random.next() * 20)) * size;
    const Vec3 place{offset, -offset, offset * 0.5F};
    Corners triangle;
    for (Vec3& corner : triangle) corner = random_point(random) * size + place;
    if (index % 7 == 0) triangle[2] = triangle[0] + (triangle[1] - triangle[0]) * random.next();  // a needle
    const Vec3 origin = random_point(random) * (4 * size) + place;
    const float s = std::floor(random.next() * 3) / 2;
    Vec3 aim = triangle[0] + (triangle[1] - triangle[0]) * s;
    if (index % 5 == 0) aim = (triangle[0] + triangle[1] + triangle[2]) * (1.0F / 3);
    Ray ray{origin, 0, nudged(aim, random) - origin, infinity};
    if (index % 4 == 1) ray.t_min = std::nextafter(1.0F, 2 * std::floor(random.next() * 3) - 2);
    if (index % 4 == 2) ray.t_max = std::nextafter(1.0F, 2 * std::floor(random.next() * 3));
    return {ray, triangle};
}

class WoopExact : public testing::TestWithParam<Contraction> {};

TEST_P(WoopExact, DecidesAsTheExactTestDoes) {
    const Method* method = find_method("woop_exact", GetParam());
    if (method == nullptr) GTEST_SKIP() << "this processor does not fuse";
    const Method& exact = *find_method("exact");
    int hits = 0, misses = 0;
    for (std::uint32_t i = 0; i < 300'000; ++i) {
        const Case c = hard_case(i);
        const bool expected = exact.test(c.ray, c.triangle).has_value();
        ASSERT_EQ(method->test(c.ray, c.triangle).has_value(), expected) << "case " << i;
        expected ? ++hits : ++misses;
    }
    EXPECT_GT(hits, 50'000);
    EXPECT_GT(misses, 50'000);
}

TEST_P(WoopExact, HitsNothingWhereNumbersAreNotFiniteOrTrianglesHaveNoArea) {
    const Method* method = find_method("woop_exact", GetParam());
    if (method == nullptr) GTEST_SKIP() << "this processor does not fuse";
    const Ray good{{0.25F, 0.25F, 2}, 0, {0, 0, -1}, infinity};
    const Corners triangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
    ASSERT_TRUE(method->test(good, triangle));
    for (const float bad : {nan, infinity, -infinity})
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Ray ray = good;
            ray.origin[axis] = bad;
            EXPECT_FALSE(method->test(ray, triangle));
            ray = good;
            ray.direction[axis] = bad;
            EXPECT_FALSE(method->test(ray, triangle));
            for (std::size_t corner = 0; corner < 3; ++corner) {
                Corners broken = triangle;
                broken[corner][axis] = bad;
                EXPECT_FALSE(method->test(good, broken));
            }
        }
    EXPECT_FALSE(method->test({good.origin, nan, good.direction, infinity}, triangle));
    EXPECT_FALSE(method->test({good.origin, 0, good.direction, nan}, triangle));
    EXPECT_FALSE(method->test({good.origin, 0, {0, 0, 0}, infinity}, triangle));
    EXPECT_FALSE(method->test(good, {Vec3{0, 0, 0}, Vec3{0.25F, 0.25F, 0}, Vec3{1, 1, 0}}));
}

INSTANTIATE_TEST_SUITE_P(Contractions, WoopExact, testing::Values(Contraction::Off, Contraction::Fast),
                         [](const auto& contraction) {
                             return std::string(contraction.param == Contraction::Off ? "Off" : "Fast");
                         });

// In every width: blocks in which some triangles are settled exactly and some are not.
TEST(WoopExactKernels, CountTheHitsOfTheExactTest) {
    std::vector<Corners> triangles;
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < 24; ++i) {
        RandomStream random(12, 0, i);
        const Vec3 a = random_point(random), b = random_point(random), c = random_point(random);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, random_point(random)});
    }
    for (std::uint32_t i = 0; i < 2000; ++i) {
        RandomStream random(12, 1, i);
        const Vec3 origin = random_point(random) * 3.0F - Vec3{1, 1, 1};
        const Corners& at = triangles[i % triangles.size()];
        const float s = std::floor(random.next() * 3) / 2;
        rays.push_back({origin, 0, nudged(at[0] + (at[2] - at[0]) * s, random) - origin, infinity});
    }
    const Method& exact = *find_method("exact");
    std::vector<std::uint32_t> expected;
    for (const Ray& ray : rays) {
        std::uint32_t hits = 0;
        for (const Corners& triangle : triangles) hits += exact.test(ray, triangle).has_value() ? 1 : 0;
        expected.push_back(hits);
    }
    for (const Kernel& kernel : all_kernels()) {
        if (kernel.method.name != "woop_exact") continue;
        PreparedTriangles prepared;
        kernel.store(triangles, prepared);
        std::vector<RayResult> results(rays.size());
        kernel.trace(prepared, rays, false, results);
        for (std::size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(results[i].hit_count, expected[i])
                << name_of(kernel.form) << " " << kernel.width << ", ray " << i;
    }
}

}  // namespace
}  // namespace rtu::model::methods
