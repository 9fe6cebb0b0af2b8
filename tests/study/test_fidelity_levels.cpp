#include <gtest/gtest.h>

#include <array>
#include <set>

#include "model/builtin_scene.hpp"
#include "model/error.hpp"
#include "study/fidelity/analytic_model.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/fidelity/fidelity_study.hpp"
#include "study/fidelity/fidelity_windows.hpp"
#include "study/scene_steps.hpp"
#include "study/validate/rtl_reference.hpp"
#include "study/validate/validate_configs.hpp"
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
    std::unique_ptr<RayPopulation> population(model::Resolution picture) {
        camera_ = model::builtin_camera();
        return picture_population(model::WorkloadKind::Primary,
                                  {loaded().mesh, image(), camera_, picture, 1});
    }
    model::Camera camera_;
};

TEST_F(BuiltinFidelity, LevelsHoldWhatEveryRayFinds) {
    const auto rays = population(resolution);
    const sim::Config config;
    const LevelResult cycle = run_cycle(config, image(), *rays);
    const double truth = cycle.estimate.cycles_per_ray;
    EXPECT_EQ(cycle.simulated_rays, 320U * 320);
    const auto holds = [&](const LevelResult& result) {
        return result.estimate.low <= truth && truth <= result.estimate.high;
    };

    const LevelResult sampled = run_sampled(config, image(), *rays, {0.03, 1});
    int inside = 0;
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
        const LevelResult result = run_sampled(config, image(), *rays, {0.03, seed});
        EXPECT_NEAR(result.estimate.cycles_per_ray, truth, 0.03 * truth) << "seed " << seed;
        inside += holds(result) ? 1 : 0;
    }
    EXPECT_GE(inside, 5) << "of 6: one in twenty may miss";
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
    const auto rays = population({288, 288});
    sim::Config config;
    config.rtu.ray_slots = 32;
    EXPECT_EQ(run_auto(config, image(), *rays, {0.35, 1}).level, "analytic");
    EXPECT_EQ(run_auto(config, image(), *rays, {0.05, 1}).level, "sampled");
    EXPECT_EQ(run_auto(config, image(), *rays, {0.006, 1}).level, "cycle");
}

// Many rays into a few kibibytes.
TEST(FidelityAuto, LeavesOutADramThatIsHardlyAsked) {
    const Ball ball;
    const model::Camera camera = model::automatic_camera(ball.mesh, ball.image);
    const model::WorkloadSetting setting(ball.mesh, ball.image, camera, {360, 360}, 1);
    const auto rays = picture_population(model::WorkloadKind::Primary, setting);
    sim::Config config;
    config.rtu.ray_slots = 32;
    config.rtu.pair.hit_units = 4;
    config.dram.latency_cycles = 0;
    const LevelResult result = run_auto(config, ball.image, *rays, {0.055, 1});
    EXPECT_EQ(result.level, "sampled");
    EXPECT_NE(result.account.find("no DRAM"), std::string::npos) << result.account;
    const double truth = run_cycle(config, ball.image, *rays).estimate.cycles_per_ray;
    EXPECT_LE(result.estimate.low, truth);
    EXPECT_GE(result.estimate.high, truth);
    config.l1.size_bytes = config.l2.size_bytes = 8192;
    EXPECT_EQ(run_auto(config, ball.image, *rays, {0.055, 1}).account.find("no DRAM"), std::string::npos);
}

TEST(FidelityAuto, FewRaysAreNotSampled) {
    const Ball ball;
    const model::Camera camera = model::automatic_camera(ball.mesh, ball.image);
    const model::WorkloadSetting setting(ball.mesh, ball.image, camera, {100, 100}, 1);
    const auto rays = picture_population(model::WorkloadKind::Primary, setting);
    const LevelResult result = run_auto({}, ball.image, *rays, {0.02, 1});
    EXPECT_EQ(result.level, "cycle");
    EXPECT_EQ(result.traced_rays, 0U) << "nothing was tried before";
}

TEST(FidelityRtl, IsTheCycleModelOnTheMachineOfTheRtl) {
    const Ball ball;
    const model::Camera camera = model::automatic_camera(ball.mesh, ball.image);
    const model::WorkloadSetting setting(ball.mesh, ball.image, camera, {24, 24}, 1);
    const auto rays = picture_population(model::WorkloadKind::Primary, setting);
    const sim::Config config = validate_configs().front().config;
    try {
        static_cast<void>(rtl_reference());
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    const LevelResult rtl = run_rtl(config, ball.image, *rays);
    EXPECT_EQ(rtl.simulated_rays, 24U * 24);
    const double cycles = run_cycle(config, ball.image, *rays).estimate.cycles_per_ray;
    EXPECT_NEAR(rtl.estimate.cycles_per_ray, cycles, 0.02 * cycles);
    EXPECT_THROW(static_cast<void>(run_rtl({}, ball.image, *rays)), Error) << "another machine";
    const model::WorkloadSetting large(ball.mesh, ball.image, camera, {400, 400}, 1);
    const auto many = picture_population(model::WorkloadKind::Primary, large);
    EXPECT_THROW(static_cast<void>(run_rtl(config, ball.image, *many)), Error) << "hours";
}

class Windows : public testing::Test {
  protected:
    Ball ball_;
    model::Camera camera_ = model::automatic_camera(ball_.mesh, ball_.image);
    std::unique_ptr<RayPopulation> rays_ =
        picture_population(model::WorkloadKind::Primary, {ball_.mesh, ball_.image, camera_, {96, 96}, 1});
    WindowPlan plan_{.stratum_count = 8,
                     .window_length = 128,
                     .settling_rays = 64,
                     .warm_length = 160,
                     .lattice_stride = 16,
                     .block_length = 32,
                     .block_stride = 512};
};

TEST_F(Windows, NewOnesTakeTheSharesThatHaveNone) {
    const WindowMeasurement first = measure_windows({}, ball_.image, *rays_, plan_);
    ASSERT_EQ(first.windows.size(), 8U);
    for (const WindowSample& window : first.windows) plan_.taken.push_back(window.begin);
    plan_.stratum_count = 32;
    EXPECT_EQ(simulated_length(plan_), 26U * (128 + 64));
    const WindowMeasurement second = measure_windows({}, ball_.image, *rays_, plan_);
    ASSERT_EQ(second.windows.size(), 24U);
    std::set<std::uint32_t> shares;
    for (const WindowMeasurement* pass : {&first, &second})
        for (const WindowSample& window : pass->windows)
            shares.insert((window.begin - 128) * 32 / (96 * 96 - 256));
    EXPECT_EQ(shares.size(), 32U);
}

TEST_F(Windows, LaterOnesLeaveOutEndsAndBlocks) {
    const WindowMeasurement whole = measure_windows({}, ball_.image, *rays_, plan_);
    EXPECT_EQ(whole.first.work.rays, 128);
    EXPECT_EQ(whole.last.work.rays, 128);
    EXPECT_FALSE(whole.blocks.empty());
    plan_.has_ends_and_blocks = false;
    EXPECT_EQ(simulated_length(plan_), 8U * (128 + 64));
    const WindowMeasurement later = measure_windows({}, ball_.image, *rays_, plan_);
    ASSERT_EQ(later.windows.size(), 8U);
    EXPECT_EQ(later.simulated_rays, 8U * (128 + 64));
    EXPECT_TRUE(later.blocks.empty());
    EXPECT_EQ(later.lattice.size(), whole.lattice.size());
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(later.windows[i].begin, whole.windows[i].begin);
}

TEST_F(Windows, TraceTheRaysThatTheyHandOver) {
    const WindowMeasurement run = measure_windows({}, ball_.image, *rays_, plan_);
    for (const WindowSample& window : run.windows) {
        EXPECT_EQ(window.traced.work.rays, window.work.rays);
        EXPECT_NEAR(window.traced.work.node_visits, window.work.node_visits, 0.5 * window.work.node_visits);
        EXPECT_GE(window.traced.least_cycles, least_cycles({}, window.traced.work) - 1e-9);
        EXPECT_GE(window.traced.least_cycles_alone, window.traced.least_cycles - 1e-9);
    }
    EXPECT_EQ(run.blocks.size(), 18U) << "17.5 strides";
    for (const TracedWork& block : run.blocks) EXPECT_EQ(block.work.rays, 32);
}

TEST_F(Windows, WithTheImageInTheL2DramIsNotAsked) {
    const auto cycles = [&](const sim::Config& config) {
        double sum = 0;
        for (const WindowSample& w : measure_windows(config, ball_.image, *rays_, plan_).windows)
            sum += w.cycles;
        return sum;
    };
    sim::Config slow;
    slow.dram.latency_cycles = 500;
    plan_.lattice_stride = plan_.block_stride = 8192;
    plan_.warm_length = plan_.settling_rays;
    EXPECT_GT(cycles(slow), cycles({}));
    plan_.has_image_in_l2 = true;
    EXPECT_EQ(cycles(slow), cycles({}));
}

// The log of a whole traversal is what the walk does step by step.
TEST(TraversalLog, IsTheWalkStepByStep) {
    const Ball ball;
    for (const model::RayKind kind : {model::RayKind::ClosestHit, model::RayKind::AnyHit}) {
        FunctionalWalk walk;
        model::TraversalStack stack;
        model::TraversalLog log;
        double pairs = 0;
        for (const model::Ray& ray : ball.rays) {
            model::trace(stack, ball.image, ray, kind, log);
            ASSERT_TRUE(walk.start(ball.image, ray, kind));
            std::size_t visited = 0;
            do {
                ASSERT_LT(visited, log.visits.size());
                EXPECT_EQ(log.visits[visited].address(), walk.address());
                EXPECT_EQ(fetched_bytes(ball.image, log.visits[visited++]), walk.size_bytes(ball.image));
            } while (walk.step(ball.image));
            EXPECT_EQ(visited, log.visits.size());
            const RayWork a = work_of(log), b = walk.work();
            EXPECT_EQ((std::array{a.rays, a.node_visits, a.box_tests, a.leaf_visits, a.pair_tests}),
                      (std::array{b.rays, b.node_visits, b.box_tests, b.leaf_visits, b.pair_tests}));
            EXPECT_EQ(
                (std::array{a.triangle_tests, a.survivor_pairs, a.survivors, a.better_hits, a.side_tests}),
                (std::array{b.triangle_tests, b.survivor_pairs, b.survivors, b.better_hits, b.side_tests}));
            pairs += a.survivor_pairs;
        }
        EXPECT_GT(pairs, 0);
        model::trace(stack, ball.image, {{0, 0, 0}, 0, {0, 0, 0}, 1}, kind, log);
        EXPECT_TRUE(log.visits.empty());
        EXPECT_EQ(work_of(log).pair_tests, 0);
    }
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
