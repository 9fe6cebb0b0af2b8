#include <gtest/gtest.h>

#include "model/builtin_scene.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/fidelity/fidelity_study.hpp"
#include "study/scene_steps.hpp"
#include "tests/sim/machine_fixture.hpp"

namespace rtu::study {
namespace {

struct Ball {
    model::TriangleMesh mesh = test::closed_sphere(12, {0.5F, 0.5F, 0.5F}, 0.4F);
    model::MemoryImage image = test::image_of(mesh);
    std::vector<model::Ray> rays = test::rays_into_unit_cube(600, 5);
};

TEST(MachineSession, StoppingAndGoingOnChangesNothing) {
    const Ball ball;
    const sim::Config config = test::tiny_machine();
    const sim::MachineResult whole = sim::simulate(config, ball.image, ball.rays, model::RayKind::ClosestHit);
    sim::SpanSupply supply(ball.rays);
    sim::MachineSession session(config, ball.image, supply, model::RayKind::ClosestHit);
    std::uint64_t last_cycle = 0;
    for (std::uint64_t count = 37; count < ball.rays.size(); count += 37) {
        session.advance_to(count);
        EXPECT_EQ(session.mark().rays, count);
        EXPECT_GT(session.mark().cycles, last_cycle);
        last_cycle = session.mark().cycles;
    }
    session.finish();
    EXPECT_EQ(session.mark().cycles, whole.cycles);
    EXPECT_EQ(session.mark().counts, whole.counts);
    EXPECT_GT(session.mark().l1_misses, 0U);
}

TEST(MachineSession, WarmCachesHaveNoMisses) {
    const Ball ball;
    const auto misses = [&](bool is_warm) {
        sim::SpanSupply supply(ball.rays);
        sim::MachineSession session({}, ball.image, supply, model::RayKind::ClosestHit);
        if (is_warm) {
            for (std::uint64_t address = 0; address < ball.image.size_bytes(); address += 64) {
                session.warm(0, address, 64);
            }
        }
        session.finish();
        return std::pair(session.mark().l1_misses, session.mark().l2_misses);
    };
    EXPECT_GT(misses(false).second, 0U);
    EXPECT_EQ(misses(true), std::pair(std::uint64_t{0}, std::uint64_t{0}));
}

// The built-in scene, small enough to simulate every ray, large enough for windows to be a part of it.
class BuiltinFidelity : public testing::Test {
  protected:
    static constexpr model::Resolution resolution{320, 320};
    const LoadedScene& loaded() {
        static const LoadedScene scene = load_scene({});
        return scene;
    }
    const model::MemoryImage& image() {
        static const BuiltScene scene = build_scene(loaded().mesh, model::parse_pairing_method("edge_bbsa"),
                                                    model::EdgeIdentity::Position, sim::Config{}.bvh);
        return scene.image;
    }
    std::unique_ptr<RayPopulation> population(model::WorkloadKind kind) {
        camera_ = model::builtin_camera();
        return picture_population(kind, {loaded().mesh, image(), camera_, resolution, 1});
    }
    model::Camera camera_;
};

TEST_F(BuiltinFidelity, LevelsHoldWhatEveryRayFinds) {
    const auto rays = population(model::WorkloadKind::Primary);
    const sim::Config config;
    const LevelResult cycle = run_cycle(config, image(), *rays);
    const double truth = cycle.estimate.cycles_per_ray;
    EXPECT_EQ(cycle.simulated_rays, 320U * 320);
    const auto holds = [&](const LevelResult& result) {
        return result.estimate.low <= truth && truth <= result.estimate.high;
    };

    const LevelResult sampled = run_sampled(config, image(), *rays, {0.03, 1});
    EXPECT_TRUE(holds(sampled)) << sampled.estimate.low << " to " << sampled.estimate.high;
    EXPECT_LE(sampled.estimate.relative_half_width(), 0.03);
    EXPECT_LT(3 * sampled.simulated_rays, cycle.simulated_rays);
    EXPECT_EQ(sampled.level, "sampled");
    const LevelResult again = run_sampled(config, image(), *rays, {0.03, 1});
    EXPECT_EQ(again.estimate.cycles_per_ray, sampled.estimate.cycles_per_ray);
    EXPECT_EQ(again.estimate.high, sampled.estimate.high);

    const LevelResult analytic = run_analytic(config, image(), *rays, 1);
    EXPECT_TRUE(holds(analytic)) << analytic.estimate.cycles_per_ray << " of " << truth;
    EXPECT_EQ(analytic.simulated_rays, 0U);

    const LevelResult counts = run_counts(config, image(), *rays);
    EXPECT_LE(counts.estimate.cycles_per_ray, truth);
    EXPECT_GT(counts.estimate.cycles_per_ray, 0.9 * truth) << "the box unit is its limit";
}

TEST_F(BuiltinFidelity, AutoTakesWhatTheToleranceNeeds) {
    const auto rays = population(model::WorkloadKind::Primary);
    EXPECT_EQ(run_auto({}, image(), *rays, {0.2, 1}).level, "analytic");
    EXPECT_EQ(run_auto({}, image(), *rays, {0.03, 1}).level, "sampled");
    EXPECT_EQ(run_auto({}, image(), *rays, {0.006, 1}).level, "cycle");
}

TEST(StoredPopulation, FewRaysAreAllSimulated) {
    const Ball ball;
    class Reader final : public traces::RayReader {
      public:
        explicit Reader(const std::vector<model::Ray>& rays) : rays_(rays) {}
        [[nodiscard]] const traces::TraceHeader& header() const override { return header_; }
        [[nodiscard]] std::optional<traces::RayChunk> next() override {
            if (++taken_ > 2) return std::nullopt;
            traces::RayChunk chunk;
            chunk.rays = rays_;
            return chunk;
        }
        [[nodiscard]] double share() const override { return 1; }

      private:
        const std::vector<model::Ray>& rays_;
        traces::TraceHeader header_;
        int taken_ = 0;
    } reader(ball.rays);
    const auto populations = file_populations(reader);
    ASSERT_EQ(populations.size(), 1U);
    EXPECT_EQ(populations[0]->size(), 2 * ball.rays.size());
    const LevelResult result = run_sampled({}, ball.image, *populations[0], {0.02, 1});
    EXPECT_EQ(result.level, "cycle");
    EXPECT_EQ(result.simulated_rays, 2 * ball.rays.size());
    EXPECT_EQ(result.estimate.low, result.estimate.high);
}

TEST(PicturePopulation, PartsAreThePicture) {
    const Ball ball;
    const model::Camera camera = model::automatic_camera(ball.mesh, ball.image);
    const model::WorkloadSetting setting(ball.mesh, ball.image, camera, {16, 8}, 1);
    const auto rays = picture_population(model::WorkloadKind::Diffuse, setting);
    const PopulationPart all = rays->part(0, rays->size());
    ASSERT_GT(all.rays.size(), 0U);
    ASSERT_LT(all.rays.size(), rays->size());
    const std::vector<std::uint32_t> some{all.positions.front(), all.positions.back()};
    const PopulationPart two = rays->part(some);
    EXPECT_EQ(two.positions, some);
    EXPECT_EQ(two.rays[1].direction.x, all.rays.back().direction.x);
}

}  // namespace
}  // namespace rtu::study
