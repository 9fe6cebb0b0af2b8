// Whether rays aimed at the edges and vertices of closed meshes leave them exactly once.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "model/methods/method.hpp"
#include "model/vec3.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::model::methods {
namespace {

std::vector<Corners> triangles_of(const TriangleMesh& mesh) {
    std::vector<Corners> triangles;
    for (const auto& t : mesh.triangles)
        triangles.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    return triangles;
}

// A closed cube of n x n x 2 triangles a side, its corners on whole numbers from `corner` on.
std::vector<Corners> box_grid(int n, Vec3 corner) {
    std::vector<Corners> triangles;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const float level : {0.0F, float(n)}) {
            const auto at = [&](int i, int j) {
                Vec3 p;
                p[axis] = level, p[(axis + 1) % 3] = float(i), p[(axis + 2) % 3] = float(j);
                return corner + p;
            };
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                    triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
                }
        }
    }
    return triangles;
}

struct Outcome {
    int rays = 0, leaks = 0, double_hits = 0, odd = 0;
};

void shoot(const Method& method, const std::vector<Corners>& mesh, const Ray& ray, Outcome& outcome) {
    int hits = 0;
    for (const Corners& triangle : mesh) hits += int(method.test(ray, triangle).has_value());
    ++outcome.rays;
    outcome.leaks += int(hits == 0);
    outcome.double_hits += int(hits > 1);
    outcome.odd += hits % 2;
}

// From inside a sphere at its vertices and at points of its edges; half of the origins its very centre.
Outcome shoot_out_of_sphere(const Method& method, const std::vector<Corners>& mesh, Vec3 centre) {
    test::Random random(5);
    Outcome outcome;
    for (int i = 0; i < 6000; ++i) {
        const Corners& triangle = mesh[random.below(std::uint32_t(mesh.size()))];
        const Vec3 a = triangle[random.below(3)], b = triangle[random.below(3)];
        const float s = i % 4 == 0 ? 0.0F : i % 4 == 1 ? 0.5F : random.uniform(0, 1);
        const Vec3 origin = i % 2 == 0 ? centre : centre + random.point(-0.5F, 0.5F);
        shoot(method, mesh, {origin, 0, a + s * (b - a) - origin, infinity}, outcome);
    }
    return outcome;
}

// From outside, so that a ray at the silhouette passes or enters and leaves.
Outcome shoot_at_sphere(const Method& method, const std::vector<Corners>& mesh, Vec3 centre) {
    test::Random random(6);
    Outcome outcome;
    for (int i = 0; i < 6000; ++i) {
        const Corners& triangle = mesh[random.below(std::uint32_t(mesh.size()))];
        Vec3 origin = centre + random.point(-8, 8);
        origin[i % 3] = centre[std::size_t(i) % 3] + (i % 2 == 0 ? 8.0F : -8.0F);
        shoot(method, mesh, {origin, 0, triangle[random.below(3)] - origin, infinity}, outcome);
    }
    return outcome;
}

// Along each axis, both ways, and along diagonals, through all vertices and points of the grid's edges and
// diagonals of one side.
Outcome shoot_out_of_box(const Method& method, const std::vector<Corners>& mesh, int n, Vec3 corner) {
    Outcome outcome;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int i = 1; i < 2 * n; ++i)
            for (int j = 1; j < 2 * n; ++j)
                for (const float sign : {1.0F, -1.0F}) {
                    Vec3 origin, direction{-0.0F, -0.0F, 0.0F};
                    origin[axis] = 0.5F * float(n);
                    origin[(axis + 1) % 3] = 0.5F * float(i), origin[(axis + 2) % 3] = 0.5F * float(j);
                    direction[axis] = sign;
                    shoot(method, mesh, {corner + origin, 0, direction, infinity}, outcome);
                    direction[(axis + 1) % 3] = 1;
                    shoot(method, mesh, {corner + origin, 0, direction, infinity}, outcome);
                }
    return outcome;
}

class Watertight : public testing::TestWithParam<std::tuple<Contraction, float>> {
  protected:
    void SetUp() override {
        if (all_methods(contraction()).empty()) GTEST_SKIP() << "the processor cannot fuse";
    }
    [[nodiscard]] static Contraction contraction() { return std::get<0>(GetParam()); }
    [[nodiscard]] static Vec3 centre() { return Vec3{1, -0.5F, 0.25F} * std::get<1>(GetParam()); }
    [[nodiscard]] static const Method& method(std::string_view name) {
        return *find_method(name, contraction());
    }
};

TEST_P(Watertight, ASphereIsLeftExactlyOnce) {
    const auto mesh = triangles_of(test::closed_sphere(7, centre(), 2));
    const Outcome ours = shoot_out_of_sphere(method("woop_top_left"), mesh, centre());
    EXPECT_EQ(ours.leaks, 0);
    EXPECT_EQ(ours.double_hits, 0);
    // The rays do go through edges and vertices: without owners they hit twice.
    EXPECT_GT(shoot_out_of_sphere(method("woop"), mesh, centre()).double_hits, 100);
}

TEST_P(Watertight, ASphereIsEnteredAsOftenAsLeft) {
    const auto mesh = triangles_of(test::closed_sphere(7, centre(), 2));
    EXPECT_EQ(shoot_at_sphere(method("woop_top_left"), mesh, centre()).odd, 0);
    EXPECT_GT(shoot_at_sphere(method("woop"), mesh, centre()).odd, 100);
}

TEST_P(Watertight, ABoxIsLeftExactlyOnce) {
    const Vec3 corner = centre();
    const auto mesh = box_grid(4, corner);
    const Outcome ours = shoot_out_of_box(method("woop_top_left"), mesh, 4, corner);
    EXPECT_EQ(ours.leaks, 0);
    EXPECT_EQ(ours.double_hits, 0);
    EXPECT_GT(shoot_out_of_box(method("woop"), mesh, 4, corner).double_hits, ours.rays / 2);
}

INSTANTIATE_TEST_SUITE_P(AtOffsets, Watertight,
                         testing::Combine(testing::Values(Contraction::Off, Contraction::Fast),
                                          testing::Values(0.0F, 1e3F, 1e5F)),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param) == Contraction::Off ? "Off"
                                                                                            : "Fast") +
                                    std::to_string(int(std::get<1>(test.param)));
                         });

// Collinear to the bit, yet rounding bends it as the ray sees it.
TEST(TopLeft, NeverHitsADegenerateTriangle) {
    const Method &ours = *find_method("woop_top_left"), &woop = *find_method("woop");
    test::Random random(8);
    int rounded_hits = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 a = random.point(-1, 1);
        const Vec3 step{random.uniform(-1, 1) * 0x1p-4F, 0x1p-5F, 0x1p-6F * float(random.below(64))};
        const Vec3 exact{std::ldexp(std::round(std::ldexp(step.x, 20)), -20), step.y, step.z};
        const Vec3 p{std::ldexp(std::round(std::ldexp(a.x, 20)), -20),
                     std::ldexp(std::round(std::ldexp(a.y, 20)), -20),
                     std::ldexp(std::round(std::ldexp(a.z, 20)), -20)};
        const Corners triangle{p, p + exact * float(1 + random.below(4)),
                               p + exact * float(5 + random.below(4))};
        const Vec3 origin = random.point(-3, 3);
        const Vec3 aim = triangle[0] + random.uniform(0, 1) * (triangle[2] - triangle[0]);
        const Ray ray{origin, 0, aim - origin, infinity};
        EXPECT_FALSE(ours.test(ray, triangle));
        rounded_hits += int(woop.test(ray, triangle).has_value());
    }
    EXPECT_GT(rounded_hits, 20);
}

TEST(TopLeft, NeverHitsATriangleThatIsNotFinite) {
    const Method& ours = *find_method("woop_top_left");
    const Corners triangle{Vec3{-1, -1, 2}, Vec3{3, -1, 2}, Vec3{-1, 3, 2}};
    const Ray ray{{0, 0, 0}, 0, {0, 0, 1}, infinity};
    ASSERT_TRUE(ours.test(ray, triangle));
    for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()})
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Corners broken = triangle;
                broken[corner][axis] = bad;
                EXPECT_FALSE(ours.test(ray, broken));
                Ray broken_ray = ray;
                broken_ray.origin[axis] = bad;
                EXPECT_FALSE(ours.test(broken_ray, triangle));
                broken_ray = ray;
                broken_ray.direction[axis] = bad;
                EXPECT_FALSE(ours.test(broken_ray, triangle));
            }
}

// Coordinates of all magnitudes, subnormal and near overflow too.
TEST(TopLeft, GivesFiniteNumbersForEveryHit) {
    test::Random random(9);
    const auto anything = [&] { return std::ldexp(random.uniform(-1, 1), int(random.below(276)) - 148); };
    for (const Contraction contraction : {Contraction::Off, Contraction::Fast}) {
        const Method* ours = find_method("woop_top_left", contraction);
        if (ours == nullptr) continue;
        int hits = 0;
        for (int i = 0; i < 200'000; ++i) {
            const float scale = i % 2 == 0 ? 1.0F : anything();
            const auto number = [&] { return i % 4 == 3 ? anything() : scale * random.uniform(-1, 1); };
            const auto point = [&] {
                const float x = number(), y = number(), z = number();
                return Vec3{x, y, z};
            };
            const Corners triangle{point(), point(), point()};
            const Vec3 origin = point();
            const Vec3 aim = (triangle[0] + triangle[1] + triangle[2]) * 0.3333F;
            const Ray ray{origin, 0, i % 3 == 0 ? point() : (aim - origin) * anything(), infinity};
            const auto hit = ours->test(ray, triangle);
            if (!hit) continue;
            ++hits;
            ASSERT_TRUE(std::isfinite(hit->t) && hit->t >= 0) << i;
            ASSERT_TRUE(hit->u >= 0 && hit->v >= 0 && hit->u + hit->v < 1.0001F) << i;
        }
        EXPECT_GT(hits, 20'000);
    }
}

}  // namespace
}  // namespace rtu::model::methods
