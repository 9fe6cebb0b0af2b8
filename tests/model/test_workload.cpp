#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "meshes.hpp"
#include "model/error.hpp"
#include "model/random.hpp"
#include "model/sampling.hpp"
#include "model/surface.hpp"
#include "model/traversal.hpp"
#include "model/workload.hpp"

namespace rtu::model {
namespace {

using test::closed_box;
using test::closed_sphere;
using test::image_of;
using testing::ElementsAre;

constexpr Resolution small_picture{48, 32};

Camera looking_at_origin(Vec3 eye) { return {eye, {0, 0, 0}, {0, 1, 0}, 0.5F}; }

std::uint64_t count_hits(const MemoryImage& image, const Workload& workload) {
    std::uint64_t count = 0;
    for (const Ray& ray : workload.rays) count += trace(image, ray, workload.ray_kind) ? 1U : 0U;
    return count;
}

// The known answers that come with the reference implementation of [SMDS11].
TEST(Philox, GivesThePublishedKnownAnswers) {
    EXPECT_THAT(philox({0, 0, 0, 0}, {0, 0}), ElementsAre(0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8));
    constexpr std::uint32_t ones = 0xffffffff;
    EXPECT_THAT(philox({ones, ones, ones, ones}, {ones, ones}),
                ElementsAre(0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd));
    EXPECT_THAT(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
                ElementsAre(0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1));
}

TEST(RandomStream, DependsOnSeedPurposeAndIndexOnly) {
    RandomStream a(7, 1, 42), same(7, 1, 42);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next(), same.next());
    for (RandomStream other : {RandomStream(8, 1, 42), RandomStream(7, 2, 42), RandomStream(7, 1, 43),
                               RandomStream(7 + (1ULL << 32), 1, 42)}) {
        RandomStream base(7, 1, 42);
        int equal = 0;
        for (int i = 0; i < 100; ++i) equal += base.next() == other.next() ? 1 : 0;
        EXPECT_LT(equal, 3);
    }
}

// Bounds below are five standard deviations of the mean of `count` samples.
TEST(Sampling, CosineDirectionsHaveTheDistributionsMeans) {
    constexpr int count = 20000;
    const Vec3 normal = normalized(Vec3{1, 2, -2});
    RandomStream random(1, 0, 0);
    double sum = 0, sum_of_squares = 0;
    for (int i = 0; i < count; ++i) {
        const Vec3 d = sample_cosine(random, normal);
        EXPECT_NEAR(length(d), 1.0F, 1e-6F);
        const double cosine = dot(d, normal);
        EXPECT_GT(cosine, 0);
        sum += cosine;
        sum_of_squares += cosine * cosine;
    }
    EXPECT_NEAR(sum / count, 2.0 / 3, 5 * std::sqrt(1.0 / 18 / count));
    EXPECT_NEAR(sum_of_squares / count, 0.5, 5 * std::sqrt(1.0 / 12 / count));
}

TEST(Sampling, SphereDirectionsAreUniform) {
    constexpr int count = 20000;
    RandomStream random(1, 0, 0);
    Vec3 sum;
    for (int i = 0; i < count; ++i) {
        const Vec3 d = sample_sphere(random);
        EXPECT_NEAR(length(d), 1.0F, 1e-6F);
        sum = sum + d;
    }
    const float bound = 5 * std::sqrt(count / 3.0F);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(sum[axis]), bound);
}

TEST(Sampling, DirectionsSurviveTheEndsOfTheRange) {
    for (const float scale : {1e-45F, 1e-38F, 1.0F, 1e19F, 3e38F}) {
        const auto direction = direction_of({scale, 0, 0});
        ASSERT_TRUE(direction) << scale;
        EXPECT_EQ(*direction, (Vec3{1, 0, 0}));
    }
    EXPECT_FALSE(direction_of({0, 0, 0}));
    EXPECT_FALSE(direction_of({NAN, 0, 0}));
}

TEST(Workload, PrimaryHasARayForEachPixelRowByRow) {
    const TriangleMesh mesh = closed_box(1, {-1, -1, -1}, {1, 1, 1});
    const MemoryImage image = image_of(mesh);
    const Camera camera = looking_at_origin({0, 0, 5});
    const Workload workload = make_workload(WorkloadKind::Primary, mesh, image, camera, small_picture, 1);
    ASSERT_EQ(workload.rays.size(), 48U * 32U);
    EXPECT_EQ(workload.ray_kind, RayKind::ClosestHit);
    for (std::uint32_t i = 0; i < workload.rays.size(); ++i) {
        EXPECT_EQ(workload.pixels[i], i);
        EXPECT_EQ(workload.rays[i], camera_ray(camera, small_picture, i % 48, i / 48));
    }
}

TEST(Workload, ThreadCountDoesNotChangeARay) {
    const TriangleMesh mesh = closed_sphere(12, {0, 0, 0}, 1);
    const MemoryImage image = image_of(mesh);
    for (const char* name : {"primary", "shadow", "ao", "diffuse", "random"}) {
        const auto make = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return make_workload(parse_workload_kind(name), mesh, image, looking_at_origin({1, 2, 3}),
                                 small_picture, 9);
        };
        const Workload one = make(1), many = make(4);
        EXPECT_EQ(one.rays, many.rays) << name;
        EXPECT_EQ(one.pixels, many.pixels) << name;
        EXPECT_FALSE(one.rays.empty()) << name;
    }
}

TEST(Workload, SeedChangesOnlyWhatIsRandom) {
    const TriangleMesh mesh = closed_sphere(12, {0, 0, 0}, 1);
    const MemoryImage image = image_of(mesh);
    const auto rays = [&](WorkloadKind kind, std::uint64_t seed) {
        return make_workload(kind, mesh, image, looking_at_origin({1, 2, 3}), small_picture, seed).rays;
    };
    EXPECT_EQ(rays(WorkloadKind::Primary, 1), rays(WorkloadKind::Primary, 2));
    EXPECT_EQ(rays(WorkloadKind::Shadow, 1), rays(WorkloadKind::Shadow, 2));
    EXPECT_NE(rays(WorkloadKind::Diffuse, 1), rays(WorkloadKind::Diffuse, 2));
    EXPECT_NE(rays(WorkloadKind::AmbientOcclusion, 1), rays(WorkloadKind::AmbientOcclusion, 2));
    EXPECT_NE(rays(WorkloadKind::Random, 1), rays(WorkloadKind::Random, 2));
}

// A pixel's ray is the same whatever the other pixels are: only the pixel's index counts.
TEST(Workload, SecondaryRaysComeFromThePixelsThatHit) {
    const TriangleMesh mesh = closed_sphere(16, {0, 0, 0}, 1);
    const MemoryImage image = image_of(mesh);
    const Camera camera = looking_at_origin({0, 0, 4});
    const Workload primary = make_workload(WorkloadKind::Primary, mesh, image, camera, small_picture, 1);
    const Workload diffuse = make_workload(WorkloadKind::Diffuse, mesh, image, camera, small_picture, 1);
    std::vector<std::uint32_t> hit_pixels;
    for (std::uint32_t i = 0; i < primary.rays.size(); ++i) {
        if (trace(image, primary.rays[i], RayKind::ClosestHit)) hit_pixels.push_back(i);
    }
    EXPECT_EQ(diffuse.pixels, hit_pixels);
    EXPECT_LT(hit_pixels.size(), primary.rays.size());
}

// From outside a convex body every ray off its surface escapes, so any hit at all is a ray that met the
// surface it started on; far from the origin and in tiny and huge scenes as well.
TEST(Workload, SecondaryRaysDoNotHitTheSurfaceTheyStartOn) {
    for (const float scale : {1e-6F, 1.0F, 1e6F}) {
        for (const float shift : {0.0F, 3.0F, 500.0F}) {
            const Vec3 centre = Vec3{shift, -shift, 0.5F * shift} * scale;
            const Camera camera{centre + Vec3{1, 2, 3} * scale, centre, {0, 1, 0}, 0.4F};
            for (const TriangleMesh& mesh :
                 {closed_sphere(20, centre, scale),
                  closed_box(3, centre - Vec3{1, 1, 1} * scale, centre + Vec3{1, 1, 1} * scale)}) {
                const MemoryImage image = image_of(mesh);
                for (const auto kind : {WorkloadKind::Diffuse, WorkloadKind::AmbientOcclusion}) {
                    const Workload workload = make_workload(kind, mesh, image, camera, {96, 96}, 3);
                    EXPECT_GT(workload.rays.size(), 2000U);
                    EXPECT_EQ(count_hits(image, workload), 0U)
                        << mesh.name << " scale " << scale << " shift " << shift << " " << workload.name;
                }
            }
        }
    }
}

TEST(Workload, DiffuseRaysInAClosedRoomAllHitAnotherWall) {
    const TriangleMesh mesh = closed_box(4, {-3, -1, -2}, {3, 1, 2});
    const MemoryImage image = image_of(mesh);
    const Camera camera{{0.3F, 0.2F, 0.1F}, {3, 0, 0}, {0, 1, 0}, 1.0F};
    const Workload workload = make_workload(WorkloadKind::Diffuse, mesh, image, camera, {96, 96}, 3);
    ASSERT_EQ(workload.rays.size(), 96U * 96U);
    for (const Ray& ray : workload.rays) {
        const auto hit = trace(image, ray, RayKind::ClosestHit);
        ASSERT_TRUE(hit);
        // The wall that it started on is the one whose plane holds the origin; the hit's wall must be
        // another.
        const auto normal = geometric_normal(mesh, hit->primitive_id);
        ASSERT_TRUE(normal);
        const Vec3 on_wall = mesh.positions[mesh.triangles[hit->primitive_id][0]];
        EXPECT_GT(std::abs(dot(*normal, ray.origin - on_wall)), 0.0F);
        EXPECT_GT(hit->t, 0.0F);
    }
}

TEST(Workload, ShadowRaysEndJustBeforeOnePoint) {
    const TriangleMesh mesh = closed_sphere(16, {0, 0, 0}, 1);
    const MemoryImage image = image_of(mesh);
    const Workload workload =
        make_workload(WorkloadKind::Shadow, mesh, image, looking_at_origin({0, 0, 4}), small_picture, 1);
    EXPECT_EQ(workload.ray_kind, RayKind::AnyHit);
    ASSERT_GT(workload.rays.size(), 1U);
    const auto end = [](const Ray& ray) { return ray.origin + ray.direction * (ray.t_max / (1 - 0x1p-12F)); };
    const Vec3 light = end(workload.rays.front());
    for (const Ray& ray : workload.rays) EXPECT_LT(length(end(ray) - light), 1e-5F);
    const std::uint64_t shadowed = count_hits(image, workload);
    EXPECT_GT(shadowed, 0U);                        // the light is not at the eye ...
    EXPECT_LT(shadowed, workload.rays.size() / 2);  // ... but near it
}

TEST(Workload, LightStaysInTheRoom) {
    const TriangleMesh mesh = closed_box(2, {-3, -1, -2}, {3, 1, 2});
    const MemoryImage image = image_of(mesh);
    const Camera camera{{0.3F, 0.2F, 0.1F}, {3, 0, 0}, {0, 1, 0}, 1.0F};
    const Workload workload = make_workload(WorkloadKind::Shadow, mesh, image, camera, small_picture, 1);
    ASSERT_EQ(workload.rays.size(), 48U * 32U);
    EXPECT_EQ(count_hits(image, workload), 0U);  // nothing stands in an empty room's light
}

TEST(Workload, AmbientOcclusionReachesATenthOfTheDiagonal) {
    const TriangleMesh mesh = closed_box(2, {0, 0, 0}, {3, 4, 12});
    const MemoryImage image = image_of(mesh);
    const Workload workload = make_workload(WorkloadKind::AmbientOcclusion, mesh, image,
                                            {{-9, 9, 20}, {1, 2, 6}, {0, 1, 0}, 0.5F}, small_picture, 1);
    ASSERT_FALSE(workload.rays.empty());
    for (const Ray& ray : workload.rays) EXPECT_FLOAT_EQ(ray.t_max, 1.3F);
}

TEST(Workload, RandomRaysStartInTheBoxAndGoBothWays) {
    const TriangleMesh mesh = closed_box(1, {-1, 2, 5}, {1, 3, 9});
    const MemoryImage image = image_of(mesh);
    const Workload workload =
        make_workload(WorkloadKind::Random, mesh, image, looking_at_origin({9, 9, 9}), {64, 64}, 1);
    ASSERT_EQ(workload.rays.size(), 64U * 64U);
    int forward = 0;
    for (const Ray& ray : workload.rays) {
        EXPECT_TRUE(image.bounds.contains(ray.origin));
        EXPECT_NEAR(length(ray.direction), 1.0F, 1e-6F);
        forward += ray.direction.z > 0 ? 1 : 0;
    }
    EXPECT_NEAR(forward, 2048, 5 * 32);                 // five standard deviations
    EXPECT_EQ(count_hits(image, workload), 64U * 64U);  // a closed box lets none out
}

TEST(Workload, AFlatSceneGivesFiniteRays) {
    TriangleMesh mesh{
        "flat", {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {2, 0, 2}}, {{0, 1, 2}, {0, 0, 3}, {0, 3, 3}}};
    const MemoryImage image = image_of(mesh);
    for (const auto kind : {WorkloadKind::Primary, WorkloadKind::Shadow, WorkloadKind::AmbientOcclusion,
                            WorkloadKind::Diffuse, WorkloadKind::Random}) {
        const Workload workload = make_workload(
            kind, mesh, image, {{0.3F, 2, 0.3F}, {0.3F, 0, 0.3F}, {0, 0, 1}, 0.5F}, small_picture, 1);
        EXPECT_FALSE(workload.rays.empty());
        for (const Ray& ray : workload.rays) {
            EXPECT_TRUE(is_finite(ray.origin) && is_finite(ray.direction)) << workload.name;
            EXPECT_GT(ray.t_max, 0) << workload.name;
        }
    }
}

TEST(Surface, ATriangleWithoutAreaHasNoNormal) {
    const TriangleMesh mesh{
        "t", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {1e-30F, 0, 0}, {0, 1e-30F, 0}}, {{0, 1, 2}, {0, 3, 4}}};
    EXPECT_FALSE(geometric_normal(mesh, 0));
    EXPECT_EQ(geometric_normal(mesh, 1), (Vec3{0, 0, 1}));  // tiny, but not without area
    EXPECT_FALSE(surface_point(mesh, {1, 0.25F, 0.25F, 0}, {0, 0, 1}));
}

TEST(WorkloadKind, NamesAreParsedBackAndOthersRefused) {
    for (const auto kind : {WorkloadKind::Primary, WorkloadKind::Shadow, WorkloadKind::AmbientOcclusion,
                            WorkloadKind::Diffuse, WorkloadKind::Random}) {
        EXPECT_EQ(parse_workload_kind(to_string(kind)), kind);
    }
    EXPECT_THROW(static_cast<void>(parse_workload_kind("Primary")), Error);
    EXPECT_THROW(static_cast<void>(parse_workload_kind("")), Error);
}

}  // namespace
}  // namespace rtu::model
