#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "model/methods/kernel.hpp"
#include "model/random.hpp"
#include "tests/model/random_points.hpp"

namespace rtu::model::methods {
namespace {

// Pairs (a, b, c), (a, c, d) in the unit cube.
std::vector<Corners> random_triangles(std::uint32_t pairs) {
    std::vector<Corners> triangles;
    for (std::uint32_t i = 0; i < pairs; ++i) {
        RandomStream random(3, 1, i);
        const Vec3 a = random_point(random), b = random_point(random), c = random_point(random);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, random_point(random)});
    }
    return triangles;
}

std::vector<Ray> random_rays(std::uint32_t count) {
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        RandomStream random(3, 2, i);
        const Vec3 origin = random_point(random);
        rays.push_back({origin, 0, random_point(random) - origin, i % 3 == 0 ? 0.75F : 1e30F});
    }
    return rays;
}

// The second of each pair (a, b, c), (a, c, d) as (a, d, c).
std::vector<Corners> with_second_reversed(std::vector<Corners> triangles) {
    for (std::size_t i = 1; i < triangles.size(); i += 2) std::swap(triangles[i][1], triangles[i][2]);
    return triangles;
}

// What the method's single call says of every ray and triangle.
std::vector<RayResult> one_by_one(const Method& method, Form form, const std::vector<Corners>& as_given,
                                  const std::vector<Ray>& rays) {
    const bool is_reversed = form == Form::Pairs && method.info.is_pair_reversed;
    const auto triangles = is_reversed ? with_second_reversed(as_given) : as_given;
    std::vector<RayResult> results;
    for (const Ray& ray : rays) {
        RayResult result;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const auto hit = method.test(ray, triangles[i]);
            if (!hit) continue;
            if (result.hit_count++ == 0 || hit->t < result.nearest.t) {
                result.nearest = *hit;
                result.triangle = i;
                if (is_reversed && i % 2 == 1) std::swap(result.nearest.u, result.nearest.v);
            }
        }
        results.push_back(result);
    }
    return results;
}

std::string text(const Kernel& kernel) {
    return std::string(kernel.method.name) + " " + std::string(name_of(kernel.form)) + " " +
           std::to_string(kernel.width);
}

std::vector<RayResult> traced(const Kernel& kernel, const std::vector<Corners>& triangles,
                              const std::vector<Ray>& rays, bool shrinks) {
    PreparedTriangles prepared;
    kernel.store(triangles, prepared);
    std::vector<RayResult> results(rays.size());
    kernel.trace(prepared, rays, shrinks, results);
    return results;
}

// 2 * 37 triangles and 101 rays: no width divides them.
TEST(MethodKernels, GiveWhatTheSingleCallGivesInEveryFormAndWidth) {
    const auto triangles = random_triangles(37);
    const auto rays = random_rays(101);
    for (const Kernel& kernel : all_kernels()) {
        const Method& method = *find_method(kernel.method.name);
        const auto expected = one_by_one(method, kernel.form, triangles, rays);
        const auto results = traced(kernel, triangles, rays, false);
        for (std::size_t i = 0; i < rays.size(); ++i)
            EXPECT_TRUE(results[i] == expected[i]) << text(kernel) << ", ray " << i;
        EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](auto& r) { return r.hit_count > 1; }),
                  20)
            << text(kernel);
    }
}

// Small whole numbers: many edges pass exactly through a ray.
TEST(MethodKernels, SettleTiesAsTheSingleCallDoes) {
    std::vector<Corners> triangles;
    std::vector<Ray> rays;
    const auto whole = [](RandomStream& random) {
        const Vec3 p = random_point(random) * 5.0F;
        return Vec3{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    };
    for (std::uint32_t i = 0; i < 50; ++i) {
        RandomStream random(4, 1, i);
        const Vec3 a = whole(random), b = whole(random), c = whole(random);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, whole(random)});
        rays.push_back({whole(random) - Vec3{0, 0, 9}, 0, {0, 0, 1}, 1e30F});
        rays.push_back({whole(random) + Vec3{9, 9, 0}, 0, {-1, -1, 0}, 1e30F});
        rays.push_back({whole(random), 0, {-0.0F, 1, 0}, 1e30F});
    }
    for (const Kernel& kernel : all_kernels()) {
        if (kernel.method.name != "woop_top_left" && kernel.method.name != "woop_double") continue;
        const auto expected = one_by_one(*find_method(kernel.method.name), kernel.form, triangles, rays);
        const auto results = traced(kernel, triangles, rays, false);
        for (std::size_t i = 0; i < rays.size(); ++i)
            EXPECT_TRUE(results[i] == expected[i]) << text(kernel) << ", ray " << i;
    }
}

TEST(MethodKernels, FindTheSameNearestHitWithAShrinkingInterval) {
    const auto triangles = random_triangles(37);
    const auto rays = random_rays(101);
    for (const Kernel& kernel : all_kernels()) {
        const auto all = traced(kernel, triangles, rays, false),
                   least = traced(kernel, triangles, rays, true);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(least[i].hit_count > 0, all[i].hit_count > 0) << text(kernel) << ", ray " << i;
            EXPECT_EQ(least[i].nearest, all[i].nearest) << text(kernel) << ", ray " << i;
            EXPECT_EQ(least[i].triangle, all[i].triangle) << text(kernel) << ", ray " << i;
        }
    }
}

TEST(MethodKernels, TakeOneTriangleAndOneRay) {
    const std::vector<Corners> triangles = random_triangles(1);
    const Corners& first = triangles[0];
    const Vec3 centre = (first[0] + first[1] + first[2]) * (1.0F / 3);
    const std::vector<Ray> rays{
        {{2, 3, 4}, 0, centre - Vec3{2, 3, 4}, std::numeric_limits<float>::infinity()}};
    for (const Kernel& kernel : all_kernels()) {
        if (kernel.form == Form::Pairs) continue;
        const auto results = traced(kernel, {first}, rays, true);
        EXPECT_EQ(results[0].hit_count, kernel.method.is_one_sided ? results[0].hit_count : 1)
            << text(kernel);
        EXPECT_EQ(results[0].triangle, 0) << text(kernel);
    }
}

TEST(MethodKernels, ExistInEveryFormForEveryMethod) {
    for (const Method& method : all_methods()) {
        if (method.info.name == "exact" || method.info.name == "havel_herout_sse4") continue;
        for (const Form form : {Form::Single, Form::Rays, Form::Triangles})
            EXPECT_TRUE(std::any_of(all_kernels().begin(), all_kernels().end(), [&](const Kernel& kernel) {
                return kernel.method.name == method.info.name && kernel.form == form;
            })) << method.info.name;
    }
}

}  // namespace
}  // namespace rtu::model::methods
