#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <set>

#include "study/fidelity/analytic_model.hpp"
#include "study/fidelity/fidelity_estimate.hpp"
#include "study/fidelity/fidelity_study.hpp"
#include "study/fidelity/fidelity_windows.hpp"
#include "study/fidelity/queueing.hpp"
#include "study/fidelity/reuse_distance.hpp"

namespace rtu::study {
namespace {

// Of n equal stations: N / (D (N + n - 1)).
TEST(Queueing, BalancedNetworkHasItsClosedForm) {
    const std::vector<double> demands{2, 2, 2};
    for (const std::uint32_t customers : {1U, 2U, 7U, 128U}) {
        EXPECT_NEAR(closed_network_throughput(demands, 0, customers), customers / (2.0 * (customers + 2)),
                    1e-12);
    }
}

TEST(Queueing, ThroughputIsBoundedByTheSlowestStationAndByTheRound) {
    const std::vector<double> demands{1, 4, 2};
    EXPECT_NEAR(closed_network_throughput(demands, 10, 1), 1 / 17.0, 1e-12);
    EXPECT_NEAR(closed_network_throughput(demands, 10, 1000), 1 / 4.0, 1e-6);
    EXPECT_EQ(closed_network_throughput({}, 0, 5), 0);
}

TEST(Queueing, NodesShareLanesAsFarAsTheyFit) {
    const auto all_with = [](std::size_t children) {
        std::vector<double> nodes(9, 0);
        nodes[children] = 10;
        return nodes;
    };
    EXPECT_NEAR(packed_cycles_per_node(all_with(4), 4), 1, 1e-9);
    EXPECT_NEAR(packed_cycles_per_node(all_with(3), 4), 1, 1e-9);
    EXPECT_NEAR(packed_cycles_per_node(all_with(2), 4), 0.5, 1e-9);
    EXPECT_NEAR(packed_cycles_per_node(all_with(8), 4), 2, 1e-9);
    EXPECT_NEAR(packed_cycles_per_node(all_with(4), 1), 4, 1e-9);
    EXPECT_EQ(packed_cycles_per_node(std::vector<double>(9, 0), 4), 0);
}

TEST(Queueing, BanksServeUntilTheFirstConflict) {
    EXPECT_DOUBLE_EQ(in_order_bank_rate(1, 8), 1);
    EXPECT_DOUBLE_EQ(in_order_bank_rate(4, 2), 1.75);
    EXPECT_DOUBLE_EQ(in_order_bank_rate(2, 2), 1.5);
}

// The definition, slowly: distinct lines of all accesses since the block's last, its own line left out.
TEST(ReuseDistance, EqualsItsDefinition) {
    constexpr std::uint64_t blocks = 200;
    ReuseDistances distances(128, blocks * 64);
    std::mt19937 random(3);
    std::vector<std::uint64_t> past;
    for (int i = 0; i < 3000; ++i) {
        const std::uint64_t block = random() % (i % 7 == 0 ? blocks : 40);
        std::uint64_t expected = ReuseDistances::never;
        std::set<std::uint64_t> lines;
        for (std::size_t k = past.size(); k-- > 0;) {
            if (past[k] == block) {
                expected = lines.size();
                break;
            }
            if (past[k] / 2 != block / 2) lines.insert(past[k] / 2);
        }
        ASSERT_EQ(distances.access(block * 64, 64), expected) << "access " << i;
        past.push_back(block);
    }
}

TEST(KendallTau, CountsPairsInOrder) {
    EXPECT_DOUBLE_EQ(kendall_tau({1, 2, 3, 4}, {10, 20, 30, 40}), 1);
    EXPECT_DOUBLE_EQ(kendall_tau({1, 2, 3, 4}, {4, 3, 2, 1}), -1);
    EXPECT_DOUBLE_EQ(kendall_tau({1, 2, 3}, {1, 3, 2}), 1.0 / 3);
    EXPECT_DOUBLE_EQ(kendall_tau({1, 2, 3}, {5, 5, 5}), 0);
}

TEST(Estimate, QuantilesAreThoseOfTables) {
    EXPECT_NEAR(t_quantile(1), 12.706, 1e-3);
    EXPECT_NEAR(t_quantile(10), 2.228, 1e-3);
    EXPECT_NEAR(t_quantile(1000), 1.962, 1e-3);
}

// A workload whose work per position varies along it, and whose windows cost their work and some noise.
class SyntheticRun {
  public:
    SyntheticRun(double noise, std::uint32_t seed) : noise_(noise), random_(seed) {}

    WindowMeasurement measure() {
        WindowMeasurement run;
        run.window_length = length;
        run.middle_length = std::uint64_t(windows) * length;
        run.block_length = length / blocks;
        run.first = run.last = {0, {}};
        for (int k = 0; k < 20; ++k)
            run.windows.push_back(window(std::uint32_t((k + uniform()) * windows / 20)));
        for (int i = 0; i < 200; ++i) run.blocks.push_back(block(std::uint32_t(i)));
        for (int i = 0; i < 4000; ++i) run.lattice.push_back(position((i + uniform()) / 4000));
        return run;
    }
    // Without noise: cycles are nodes and a quarter of the pairs.
    static double truth() {
        double cycles = 0;
        for (std::uint32_t i = 0; i < windows; ++i) cycles += cycles_of(mean_work((i + 0.5) / windows));
        return cycles / windows;
    }

  private:
    static constexpr std::uint32_t length = 500, windows = 1000, blocks = 5;

    static RayWork mean_work(double place) {
        const double nodes = 10 + 8 * std::sin(9 * place);
        return {1, nodes, 4 * nodes, 1 + place, 1 + place, 2 + place};
    }
    static double cycles_of(const RayWork& work) { return work.node_visits + 0.25 * work.pair_tests; }
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    RayWork position(double place) {
        RayWork work = mean_work(place);
        work.node_visits *= 0.5 + uniform();
        work.box_tests = 4 * work.node_visits;
        return work;
    }
    WindowSample window(std::uint32_t index) {
        const RayWork work = double(length) * mean_work((index + 0.5) / windows);
        const double factor = 1 + noise_ * std::normal_distribution<double>()(random_);
        return {cycles_of(work) * factor, work, {work, 0}, index * length};
    }
    // Their least cycles say nothing that their work does not.
    TracedWork block(std::uint32_t index) {
        const RayWork work = double(length) / blocks * mean_work((index + 0.5) / 200);
        return {work, 4 * work.node_visits, work.node_visits};
    }

    double noise_;
    std::mt19937 random_;
};

TEST(Estimate, IsExactButForTheLatticeWhenWindowsCostTheirWork) {
    SyntheticRun run(0, 1);
    const std::vector<WindowMeasurement> passes{run.measure()};
    const CycleEstimate estimate = estimate_cycles({}, passes);
    EXPECT_NEAR(estimate.cycles_per_ray, SyntheticRun::truth(), 0.02 * SyntheticRun::truth());
    EXPECT_LT(estimate.relative_half_width(), 0.02);
    EXPECT_NEAR(estimate.rays, 500'000, 1e-3);
}

// Of intervals that hold the truth 95 times in 100, fewer hold it once in forty series of so many.
double fewest_inside(int trials) { return trials * (0.95 - 1.96 * std::sqrt(0.95 * 0.05 / trials)); }

TEST(Estimate, IntervalHoldsTheTruthAsOftenAsItSays) {
    constexpr int trials = 600;
    int inside = 0;
    for (int trial = 0; trial < trials; ++trial) {
        SyntheticRun run(0.1, std::uint32_t(trial) + 10);
        const std::vector<WindowMeasurement> passes{run.measure()};
        const CycleEstimate estimate = estimate_cycles({}, passes);
        if (estimate.low <= SyntheticRun::truth() && SyntheticRun::truth() <= estimate.high) ++inside;
    }
    EXPECT_GE(inside, fewest_inside(trials));
    EXPECT_LT(inside, 0.99 * trials) << "too wide: nothing is gained by an interval that holds everything";
}

// Later passes bring windows and a lattice; the ends of the run and the blocks are those of the first.
TEST(Estimate, LaterPassesAreOneSampleWithTheFirst) {
    SyntheticRun run(0.1, 3);
    WindowMeasurement first = run.measure();
    first.first = {7000, {.rays = 500}};
    const CycleEstimate alone = estimate_cycles({}, std::vector{first});
    EXPECT_NEAR(alone.rays, 500'500, 1e-3);
    std::vector<WindowMeasurement> passes{first};
    for (int i = 0; i < 3; ++i) {
        passes.push_back(run.measure());
        passes.back().blocks.clear();
        passes.back().block_length = 0;
    }
    const CycleEstimate together = estimate_cycles({}, passes);
    EXPECT_NEAR(together.rays, 500'500, 1e-3);
    EXPECT_LT(together.relative_half_width(), 0.6 * alone.relative_half_width());
}

// A run of stretches that the host's rate limits and stretches that the box lanes do, in patches of any size,
// and windows whose scatter is a power of their cycles: the zeroth where all scatter alike, the root where
// they do like sums of independent rays, the first where each is off by a share of itself. What the windows
// cannot know of the rest, blocks and lattice tell.
class PatchyRun {
  public:
    PatchyRun(double power, std::uint32_t seed) : power_(power), random_(seed) {}

    static constexpr std::uint32_t length = 512, block = 16, windows = 1000;

    // Boxes of each ray of a position of the run.
    static double boxes(double place) {
        const double patch = std::sin(70 * place) + std::sin(31 * place) + 0.5 * std::sin(1700 * place);
        return patch < 0.4 ? 1 : 40 + 30 * std::sin(8 * place);
    }
    static RayWork work_of(double place) {
        const double b = boxes(place);
        return {.rays = 1, .node_visits = b / 4, .box_tests = b};
    }
    static TracedWork stretch(double begin, std::uint32_t positions) {
        TracedWork all;
        RayWork of_block;
        for (std::uint32_t i = 0; i < positions; ++i) {
            const RayWork work = work_of(begin + i / (double(length) * windows));
            all.least_cycles_alone += least_cycles({}, work);
            of_block += work;
            if (i % block != block - 1) continue;
            all.work += of_block;
            all.least_cycles += least_cycles({}, of_block);
            of_block = {};
        }
        return all;
    }
    static double truth() {
        static const double cycles = stretch(0, length * windows).least_cycles / (length * double(windows));
        return 1.2 * cycles;
    }

    WindowMeasurement measure(std::uint32_t count) {
        WindowMeasurement run;
        run.window_length = length;
        run.block_length = block;
        run.middle_length = std::uint64_t(length) * windows;
        for (std::uint32_t k = 0; k < count; ++k) {
            const double begin = (k + uniform() * (1 - double(count) / windows)) / count;
            WindowSample& window = run.windows.emplace_back();
            window.traced = stretch(begin, length);
            window.work = window.traced.work;
            window.begin = std::uint32_t(begin * length * windows);
            const double cycles = 1.2 * window.traced.least_cycles;
            const double mean = length * truth();
            window.cycles = cycles + 0.05 * mean * std::pow(cycles / mean, power_) * normal_(random_);
        }
        for (int i = 0; i < 600; ++i) run.blocks.push_back(stretch((i + uniform()) / 600, block));
        for (int i = 0; i < 6000; ++i) run.lattice.push_back(work_of((i + uniform()) / 6000));
        return run;
    }

  private:
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    double power_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
};

class PatchyScatter : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Powers, PatchyScatter, testing::Values(0.0, 0.5, 1.0));

TEST_P(PatchyScatter, IntervalHoldsTheTruthAsOftenAsItSays) {
    constexpr int trials = 250;
    int inside = 0;
    double widths = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const std::vector<WindowMeasurement> passes{PatchyRun(GetParam(), std::uint32_t(trial)).measure(24)};
        const CycleEstimate estimate = estimate_cycles({}, passes);
        if (estimate.low <= PatchyRun::truth() && PatchyRun::truth() <= estimate.high) ++inside;
        widths += estimate.relative_half_width() / trials;
    }
    EXPECT_GE(inside, fewest_inside(trials));
    EXPECT_LT(inside, 0.99 * trials);
    EXPECT_LT(widths, 0.04) << "the windows' own scatter is 5 %, that of their cycles 80 %";
}

TEST(Estimate, ABiasAddsAsSquaresDo) {
    const CycleEstimate estimate{10, 9.7, 10.3, 100};
    const CycleEstimate wide = widened(estimate, 0.04, 0);
    EXPECT_NEAR(wide.low, 9.5, 1e-9);
    EXPECT_NEAR(wide.high, 10.5, 1e-9);
    EXPECT_NEAR(widened(estimate, 0.04, 0.01).high, 10.6, 1e-9);
    EXPECT_NEAR(widened(estimate, 0.04, 0.01).low, 9.5, 1e-9);
    EXPECT_EQ(widened({}, 0.005, 0).cycles_per_ray, 0);
    EXPECT_EQ(widened({1, 0, 9, 1}, 0, 0).low, 0) << "never below nothing";
}

TEST(Estimate, NoRaysGiveNothing) {
    WindowMeasurement empty;
    empty.window_length = 10;
    empty.middle_length = 100;
    empty.windows.resize(3);
    empty.lattice.resize(5);
    empty.blocks.resize(2);
    empty.block_length = 5;
    const CycleEstimate estimate = estimate_cycles({}, std::vector{empty});
    EXPECT_EQ(estimate.rays, 0);
    EXPECT_EQ(estimate.cycles_per_ray, 0);
}

// Blocks of rays that miss, which the host feeds one a cycle, and of rays that keep the hit units: what a
// window costs is linear in the cycles of the busiest unit of each block, and in nothing else.
TEST(Estimate, TheBusiestUnitOfEachBlockTellsWhatSumsDoNot) {
    const sim::Config config;
    const RayWork misses{.rays = 10, .node_visits = 10, .box_tests = 10};
    const RayWork hits{.rays = 10, .node_visits = 10, .box_tests = 40, .survivors = 10, .better_hits = 5};
    std::mt19937 random(4);
    WindowMeasurement run;
    run.window_length = 40;
    run.block_length = 10;
    run.middle_length = 400'000;
    double sum = 0;
    for (std::uint32_t k = 0; k < 16; ++k) {
        WindowSample& window = run.windows.emplace_back();
        window.begin = k * 25'000;
        for (int b = 0; b < 4; ++b) {
            const RayWork block = (k + b) % 2 == 0 ? misses : double(1 + random() % 3) * hits;
            window.work += block;
            window.traced.work += block;
            window.traced.least_cycles += least_cycles(config, block);
        }
        window.cycles = 1.1 * window.traced.least_cycles;
        sum += window.cycles;
    }
    for (int i = 0; i < 4000; ++i) {
        const RayWork block = i % 2 == 0 ? misses : double(1 + random() % 3) * hits;
        run.blocks.push_back({block, least_cycles(config, block), least_cycles(config, block)});
        run.lattice.push_back(0.1 * block);
    }
    double truth = 0;
    for (const TracedWork& block : run.blocks) truth += 1.1 * block.least_cycles / 40'000;
    const CycleEstimate estimate = estimate_cycles(config, std::vector{run});
    const double per_position = estimate.cycles_per_ray * estimate.rays / 400'000;
    EXPECT_NEAR(per_position, truth, 0.002 * truth);
    EXPECT_GT(std::abs(sum / 16 / 40 - truth), 0.01 * truth) << "the windows' mean alone would not do";
}

// What varies slowly along a run is no error of windows that are spread over it.
TEST(Estimate, NeighboursTellTheIntervalWhereTheRunDrifts) {
    const auto width = [](bool is_in_order) {
        WindowMeasurement run;
        run.window_length = 10;
        run.block_length = 10;
        run.middle_length = 10'000;
        for (std::uint32_t k = 0; k < 64; ++k) {
            const std::uint32_t place = is_in_order ? k : k * 27 % 64;
            WindowSample& window = run.windows.emplace_back();
            window.work.rays = 10;
            window.cycles = 100 + k;
            window.begin = 100 * place;
        }
        run.lattice.resize(100, {.rays = 1});
        return estimate_cycles({}, std::vector{run}).relative_half_width();
    };
    EXPECT_LT(width(true), 0.2 * width(false));
}

WorkloadProfile uniform_profile(double nodes, double pairs) {
    WorkloadProfile profile;
    profile.nodes_with[4] = 1;
    ProfileBlock& block = profile.blocks.emplace_back();
    block.rays = 1e6;
    block.per_ray = {.rays = 1,
                     .node_visits = nodes,
                     .box_tests = 4 * nodes,
                     .leaf_visits = pairs,
                     .pair_tests = pairs,
                     .triangle_tests = 2 * pairs,
                     .survivor_pairs = pairs / 2,
                     .survivors = pairs,
                     .better_hits = pairs / 4};
    return profile;
}

TEST(AnalyticModel, TheSlowestUnitSetsTheRate) {
    const WorkloadProfile profile = uniform_profile(20, 2);
    sim::Config config;
    const AnalyticResult box = analyse(config, profile);
    EXPECT_NEAR(box.cycles_per_ray, 20, 0.1);
    EXPECT_EQ(box.bottleneck, "box");
    config.rtu.pair.ii_cycles = 40;
    config.rtu.pair.hit_units = 0;
    const AnalyticResult pair = analyse(config, profile);
    EXPECT_NEAR(pair.cycles_per_ray, 80, 0.1);
    EXPECT_EQ(pair.bottleneck, "pair");
    config.rtu.count = 2;
    config.host.rays_per_cycle = 2;
    EXPECT_NEAR(analyse(config, profile).cycles_per_ray, 40, 0.1);
}

TEST(AnalyticModel, FewHitUnitsSetTheRate) {
    sim::Config config;
    config.rtu.pair.hit_units = 2;
    const AnalyticResult result = analyse(config, uniform_profile(20, 2));
    EXPECT_NEAR(result.cycles_per_ray, (0.5 * 92 + 1.5 * 56) / 2, 0.5);
    EXPECT_EQ(result.bottleneck, "hit units");
}

TEST(AnalyticModel, AFlatMemoryIsOneBus) {
    WorkloadProfile profile = uniform_profile(20, 2);
    profile.blocks.front().l1_misses_per_ray = 10;
    sim::Config config;
    config.memory = {sim::MemoryModel::Flat, 50, 16};  // 8 cycles a line
    const AnalyticResult result = analyse(config, profile);
    EXPECT_NEAR(result.cycles_per_ray, 80, 5);
    EXPECT_EQ(result.bottleneck, "memory bus");
}

TEST(AnalyticModel, NoRunIsFasterThanItsBusiestUnit) {
    const RayWork work = uniform_profile(20, 2).blocks.front().per_ray;
    sim::Config config;
    EXPECT_DOUBLE_EQ(least_cycles(config, work), 20) << "box lanes";
    EXPECT_DOUBLE_EQ(least_cycles(config, 3 * work), 60);
    config.rtu.box.boxes_per_cycle = 80;
    EXPECT_DOUBLE_EQ(least_cycles(config, work), (0.5 * 92 + 1.5 * 56) / 8) << "hit units";
    config.rtu.pair.hit_units = 0;
    EXPECT_DOUBLE_EQ(least_cycles(config, work), 11) << "scheduler, two visits a cycle";
    config.rtu.count = 2;
    EXPECT_DOUBLE_EQ(least_cycles(config, work), 5.5);
}

TEST(AnalyticModel, OneSlotTakesItsLatency) {
    const WorkloadProfile profile = uniform_profile(20, 2);
    sim::Config config;
    config.rtu.ray_slots = 1;
    const double unloaded = unloaded_cycles(config, profile.blocks.front());
    EXPECT_DOUBLE_EQ(unloaded, 1 + 20 * (20 + 12 + 3 + 3) + 2 * (20 + 33 + 3 + 3) + 2 + 0.5 * 92 + 1.5 * 56);
    EXPECT_GT(analyse(config, profile).cycles_per_ray, unloaded);
}

TEST(AnalyticModel, MissesCostLatencyAndBandwidth) {
    WorkloadProfile profile = uniform_profile(20, 2);
    EXPECT_EQ(analyse({}, profile).memory_share, 0);
    profile.blocks.front().l1_misses_per_ray = profile.blocks.front().l2_misses_per_ray = 10;
    sim::Config config;
    config.dram.channels = 1;  // 128 bytes at 16 a cycle: 8 cycles a line
    const AnalyticResult result = analyse(config, profile);
    EXPECT_NEAR(result.cycles_per_ray, 80, 5);
    EXPECT_EQ(result.bottleneck, "dram bus");
    EXPECT_NEAR(result.memory_share, 0.75, 0.05);
}

}  // namespace
}  // namespace rtu::study
