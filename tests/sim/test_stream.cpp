#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "model/error.hpp"
#include "model/pair_test.hpp"
#include "sim/link_message.hpp"
#include "sim/stream_machine.hpp"
#include "tests/sim/machine_fixture.hpp"

namespace rtu::test {
namespace {

using sim::ClockMode;
using sim::Cycle;
using sim::ReadBack;
using sim::StreamJob;
using sim::StreamMode;
using sim::StreamPlan;
using sim::StreamResult;

struct Work {
    std::vector<model::Ray> rays;
    std::vector<model::LeafPair> pairs;
};

// Pairs and lone triangles of a sphere, the same triangles once more (so that two are hit at the same t), and
// rays of which some can hit nothing and some end early.
Work make_work(std::uint32_t ray_count, std::uint32_t pair_count) {
    const TriangleMesh mesh = closed_sphere(6, {0.5F, 0.5F, 0.5F}, 0.4F);
    Work work;
    const auto add = [&](model::PairingKind kind, std::uint32_t first_id) {
        const auto pairing = model::pair_triangles(mesh, {kind, 2}, model::EdgeIdentity::Position);
        for (const model::TrianglePair& pair : pairing.pairs) {
            work.pairs.push_back(model::make_leaf_pair(pair, mesh.positions));
            for (std::uint32_t& id : work.pairs.back().primitive_ids) id += first_id;
        }
    };
    add(model::PairingKind::None, 1000);
    add(model::PairingKind::EdgeBbsa, 0);
    work.pairs.resize(std::min<std::size_t>(work.pairs.size(), pair_count));
    work.rays = rays_into_unit_cube(ray_count, 5);
    for (std::size_t i = 0; i < work.rays.size(); i += 7) work.rays[i].t_max = 0.5F;
    if (ray_count > 3) work.rays[3].direction = {};
    return work;
}

// Both triangles lie on the same side of their common edge, so many rays pierce both.
model::LeafPair folded_pair() {
    const std::vector<Vec3> corners{{0, 0, 0.5F}, {1, 0.1F, 0.5F}, {0.9F, 0.9F, 0.5F}, {1, 0, 0.6F}};
    model::TrianglePair pair;
    pair.vertices = {0, 1, 2, 3};
    pair.primitive_ids = {2000, 2001};
    pair.has_second = true;
    return model::make_leaf_pair(pair, corners);
}

StreamJob job_of(const Work& work, StreamMode mode, std::uint64_t batch_tests,
                 ReadBack read_back = ReadBack::Tests) {
    return {work.rays, work.pairs, mode, read_back, batch_tests, 1 << 20};
}

std::vector<std::optional<model::Hit>> brute_force(const Work& work) {
    std::vector<std::optional<model::Hit>> nearest;
    for (const model::Ray& ray : work.rays) {
        std::optional<model::Hit>& best = nearest.emplace_back();
        if (!model::can_hit(ray)) continue;
        const model::RaySetup setup = model::make_ray_setup(ray, {});
        for (const model::LeafPair& pair : work.pairs) {
            const model::PairHits found = model::test_pair(pair, setup);
            for (std::size_t i = 0; i < 2; ++i) {
                const model::Hit& hit = found.hits[i];
                if (!found.is_pierced[i] || !(hit.t < ray.t_max)) continue;
                if (!best || hit.t < best->t || (hit.t == best->t && hit.primitive_id < best->primitive_id))
                    best = hit;
            }
        }
    }
    return nearest;
}

constexpr StreamMode all_modes[] = {StreamMode::Direct, StreamMode::Batched, StreamMode::Mixed,
                                    StreamMode::Resident};

bool can_read_rays(StreamMode mode) { return mode == StreamMode::Mixed || mode == StreamMode::Resident; }

sim::Config fast_link() {
    sim::Config config;
    config.link.count = 1;
    config.link.up_mb_per_second = 3000;
    config.link.down_mb_per_second = 700;
    config.link.latency_ns = 30;
    config.link.overhead_ns = 11;
    return config;
}

TEST(Stream, HitsAreBitEqualToBruteForceOverThePairTest) {
    const Work work = make_work(60, 100);
    const auto expected = brute_force(work);
    ASSERT_GT(std::ranges::count_if(expected, [](const auto& hit) { return hit.has_value(); }), 20);
    for (const StreamMode mode : all_modes) {
        for (const std::uint64_t batch : {1U, 64U, 777U, 100'000U}) {
            for (const ReadBack read_back : {ReadBack::Tests, ReadBack::Rays, ReadBack::None}) {
                if (read_back == ReadBack::Rays && !can_read_rays(mode)) continue;
                sim::Config config = fast_link();
                config.rtu.pair.testers = 1 + std::uint32_t(batch % 3);
                const auto result = sim::simulate_stream(config, job_of(work, mode, batch, read_back));
                EXPECT_EQ(result.hits, expected) << to_string(mode) << ' ' << batch;
                EXPECT_EQ(result.tests.pair_tests, 6000U);
            }
        }
    }
}

// Every test of every batch of a plan.
std::multiset<std::pair<std::uint64_t, std::uint64_t>> tests_of(const StreamPlan& plan, const Work& work) {
    std::multiset<std::pair<std::uint64_t, std::uint64_t>> tests;
    for (std::uint64_t i = 0; i < plan.batch_count(); ++i) {
        const sim::StreamBatch batch = plan.batch(i);
        const std::size_t before = tests.size();
        if (batch.list) {
            for (std::uint64_t t = batch.list->first; t < batch.list->second; ++t)
                tests.insert({t / work.pairs.size(), t % work.pairs.size()});
        } else {
            for (std::uint64_t r = batch.rays.first; r < batch.rays.second; ++r)
                for (std::uint64_t p = batch.pairs.first; p < batch.pairs.second; ++p) tests.insert({r, p});
        }
        EXPECT_EQ(tests.size() - before, batch.test_count);
        EXPECT_LE(batch.test_count, plan.most_tests());
        EXPECT_LE(std::max(batch.up_bytes, batch.down_bytes), plan.most_bytes());
    }
    return tests;
}

TEST(StreamPlan, HasEveryTestOnceInEveryModeAndBatchSize) {
    const Work work = make_work(23, 17);
    std::multiset<std::pair<std::uint64_t, std::uint64_t>> expected;
    for (std::uint64_t r = 0; r < 23; ++r)
        for (std::uint64_t p = 0; p < 17; ++p) expected.insert({r, p});
    for (const StreamMode mode : all_modes) {
        for (const std::uint64_t batch : {1U, 2U, 16U, 17U, 18U, 23U, 50U, 390U, 391U, 5000U})
            EXPECT_EQ(tests_of(StreamPlan(job_of(work, mode, batch)), work), expected) << batch;
    }
}

struct Bytes {
    std::uint64_t up = 0, down = 0;
    friend bool operator==(const Bytes&, const Bytes&) = default;
};

Bytes bytes_of(const StreamJob& job) {
    const StreamPlan plan(job);
    Bytes bytes;
    for (std::uint64_t i = 0; i < plan.batch_count(); ++i) {
        bytes.up += plan.batch(i).up_bytes;
        bytes.down += plan.batch(i).down_bytes;
    }
    EXPECT_EQ(plan.total_up_bytes(), bytes.up);
    EXPECT_EQ(plan.total_down_bytes(), bytes.down);
    return bytes;
}

TEST(StreamPlan, MovesTheBytesOfItsMode) {
    const Work work = make_work(20, 200);  // 120 lone triangles, then pairs
    const std::uint64_t rays = 20, pairs = work.pairs.size();
    std::uint64_t pair_bytes = 0, triangles = 0;
    for (const model::LeafPair& pair : work.pairs) {
        pair_bytes += pair.has_second() ? 48 : 36;
        triangles += pair.has_second() ? 2 : 1;
    }
    ASSERT_GT(triangles, pairs);
    const std::uint64_t results = rays * triangles * 16;
    for (const StreamMode mode : {StreamMode::Direct, StreamMode::Batched}) {
        EXPECT_EQ(bytes_of(job_of(work, mode, 33)), (Bytes{rays * pairs * 32 + rays * pair_bytes, results}));
    }
    // Blocks of 8, 8 and 4 rays: the pairs pass three times.
    EXPECT_EQ(bytes_of(job_of(work, StreamMode::Mixed, 8)), (Bytes{rays * 32 + 3 * pair_bytes, results}));
    EXPECT_EQ(bytes_of(job_of(work, StreamMode::Mixed, 8, ReadBack::Rays)),
              (Bytes{rays * 32 + 3 * pair_bytes, rays * 16}));
    EXPECT_EQ(bytes_of(job_of(work, StreamMode::Mixed, 300)), (Bytes{rays * 32 + pair_bytes, results}));
    EXPECT_EQ(bytes_of(job_of(work, StreamMode::Resident, 3 * pairs, ReadBack::Rays)),
              (Bytes{rays * 32 + pair_bytes, rays * 16}));
    EXPECT_EQ(bytes_of(job_of(work, StreamMode::Resident, 1)), (Bytes{rays * 32 + pair_bytes, results}));
    EXPECT_EQ(bytes_of(job_of(work, StreamMode::Batched, 64, ReadBack::None)).down, 0U);
}

TEST(StreamPlan, RefusesWhatOneTransferCannotCarryAndReadBacksThatTheModeHasNot) {
    const Work work = make_work(4, 4);
    EXPECT_THROW(StreamPlan(job_of(work, StreamMode::Batched, 4, ReadBack::Rays)), Error);
    EXPECT_THROW(StreamPlan(job_of(work, StreamMode::Direct, 4, ReadBack::Rays)), Error);
    Work large = make_work(4, 1);
    large.rays.resize(1 << 15, large.rays[0]);
    large.pairs.resize(1 << 15, large.pairs[0]);
    EXPECT_THROW(StreamPlan(job_of(large, StreamMode::Batched, 1 << 30)), Error);
    EXPECT_NO_THROW(StreamPlan(job_of(large, StreamMode::Batched, 1 << 20)));
}

TEST(Stream, TheLinkMovesThePlansBytesInOneTransferABatchEachWay) {
    const Work work = make_work(30, 130);
    for (const StreamMode mode : all_modes) {
        const StreamJob job = job_of(work, mode, 100);
        const StreamResult result = sim::simulate_stream(fast_link(), job);
        const Bytes bytes = bytes_of(job);
        EXPECT_EQ(result.link.up_bytes_arrived, bytes.up);
        EXPECT_EQ(result.link.down_bytes_arrived, bytes.down);
        EXPECT_EQ(result.link.up_transfers, result.batch_count);
        EXPECT_EQ(result.link.down_transfers, result.batch_count);
        EXPECT_EQ(result.time.total(), result.cycles);
    }
}

// The testers' time for the job, from the pair test's own counts.
std::uint64_t held_cycles(const Work& work, const sim::Config::Rtu::Pair& config) {
    std::uint64_t held = 0;
    for (const model::Ray& ray : work.rays) {
        for (const model::LeafPair& pair : work.pairs) {
            const std::uint32_t exact =
                model::can_hit(ray) ? model::test_pair(pair, model::make_ray_setup(ray, {})).exact_tests : 0;
            const std::uint32_t issues = config.mode == sim::PairMode::Single && pair.has_second() ? 2 : 1;
            held += issues * config.ii_cycles;
            if (config.mode == sim::PairMode::DualShared && exact == 2) held += config.replay_cycles;
        }
    }
    return held;
}

TEST(Stream, HoldsTheTestersAsThePairUnitDoes) {
    Work work = make_work(100, 200);
    work.pairs.push_back(folded_pair());
    for (const sim::PairMode mode :
         {sim::PairMode::Single, sim::PairMode::DualIndependent, sim::PairMode::DualShared}) {
        sim::Config config;
        config.rtu.pair.mode = mode;
        config.rtu.pair.ii_cycles = 3;
        config.rtu.pair.replay_cycles = 5;
        const std::uint64_t held = held_cycles(work, config.rtu.pair);
        const StreamResult result = sim::simulate_stream(config, job_of(work, StreamMode::Resident, 1 << 20));
        EXPECT_EQ(result.tests.tester_cycles, held);
        // One batch: three cycles each way (two channels and the link between them), the word to the host,
        // and the cycle in which it takes the results.
        const Cycle work_cycles = held - config.rtu.pair.ii_cycles + config.rtu.pair.latency_cycles;
        EXPECT_EQ(result.cycles - work_cycles, 8U);
        EXPECT_EQ(result.time.machine_cycles - work_cycles, 2U) << "the channels into and out of it";
        EXPECT_EQ(result.tests.replays > 0, mode == sim::PairMode::DualShared);
    }
}

TEST(Stream, SharesTheTestsAmongTheTestersOfAllRtus) {
    const Work work = make_work(64, 100);
    sim::Config config;
    config.rtu.pair.mode = sim::PairMode::DualIndependent;
    config.rtu.pair.ii_cycles = 4;
    const auto machine_cycles = [&](std::uint32_t rtus, std::uint32_t testers) {
        config.rtu.count = rtus;
        config.rtu.pair.testers = testers;
        const StreamResult result = sim::simulate_stream(config, job_of(work, StreamMode::Resident, 1 << 20));
        return result.time.machine_cycles - 2 - config.rtu.pair.latency_cycles + 4;
    };
    EXPECT_EQ(machine_cycles(1, 1), 6400U * 4);
    EXPECT_EQ(machine_cycles(1, 4), 6400U);
    EXPECT_EQ(machine_cycles(2, 2), 6400U);
    EXPECT_EQ(machine_cycles(2, 5), 2560U);
}

TEST(Stream, OperandsThatDoNotFitIntoTheBufferComeAtTheMemorysRate) {
    const Work work = make_work(64, 100);  // lone triangles: 68 bytes a test in a list
    sim::Config config;
    config.dram.channels = 1;
    config.dram.bytes_per_cycle = 1;
    const auto run = [&](StreamMode mode, std::uint64_t batch, std::uint64_t buffer_bytes) {
        StreamJob job = job_of(work, mode, batch);
        job.buffer_bytes = buffer_bytes;
        return sim::simulate_stream(config, job);
    };
    EXPECT_EQ(run(StreamMode::Batched, 100, 6800).tests.memory_bytes, 0U);
    const StreamResult far = run(StreamMode::Batched, 6400, 6799);
    EXPECT_EQ(far.tests.memory_bytes, 6400U * 68);
    EXPECT_EQ(far.time.machine_cycles, 6400U * 68 + config.rtu.pair.latency_cycles + 2);
    EXPECT_EQ(run(StreamMode::Mixed, 64, 64 * 32).tests.memory_bytes, 0U);
    EXPECT_EQ(run(StreamMode::Mixed, 64, 64 * 32 - 1).tests.memory_bytes, 6400U * 32);
    EXPECT_EQ(run(StreamMode::Resident, 6400, 64 * 32 + 3600).tests.memory_bytes, 0U);
    EXPECT_EQ(run(StreamMode::Resident, 6400, 64 * 32).tests.memory_bytes, 3600U) << "each pair once";
    EXPECT_EQ(run(StreamMode::Resident, 3200, 0).tests.memory_bytes, 2 * 3600U + 6400 * 32);
}

TEST(Stream, ADirectTestTakesTwoTransfersAndItsOwnTime) {
    const Work work = make_work(10, 10);
    sim::Config config = fast_link();
    config.link.buffers = 8;  // a call returns with its result all the same
    config.rtu.pair.mode = sim::PairMode::DualIndependent;
    const StreamResult result = sim::simulate_stream(config, job_of(work, StreamMode::Direct, 1));
    const Cycle up = 11 + (68 + 2) / 3 + 30, down = 11 + (16 * 10 + 6) / 7 + 30;
    const Cycle links = 4, word = 1;  // the channels into and out of the link, twice; the word to the host
    EXPECT_EQ(result.cycles, 100 * (up + config.rtu.pair.latency_cycles + down + links + word) + 1);
    EXPECT_EQ(result.batch_count, 100U);
}

TEST(Stream, CostGrowsInProportionToTheNumberOfTests) {
    sim::Config config = fast_link();
    for (const StreamMode mode : all_modes) {
        const auto cycles = [&](std::uint32_t rays) {
            return double(sim::simulate_stream(config, job_of(make_work(rays, 100), mode, 256)).cycles);
        };
        EXPECT_NEAR(cycles(400) / cycles(100), 4.0, 0.12) << to_string(mode);
    }
}

TEST(Stream, DoesNotDependOnTheClockMode) {
    const Work work = make_work(20, 60);
    for (const StreamMode mode : all_modes) {
        for (const std::uint32_t buffers : {1U, 2U, 4U}) {
            sim::Config config = fast_link();
            config.link.buffers = buffers;
            config.link.outstanding = 3;
            config.link.wires = 1 + buffers % 2;
            config.rtu.pair.testers = buffers;
            config.dram.channels = config.dram.bytes_per_cycle = 1;
            StreamJob job = job_of(work, mode, 50);
            job.buffer_bytes = 1000;
            const StreamResult fast = sim::simulate_stream(config, job);
            const StreamResult verified = sim::simulate_stream(config, job, ClockMode::Verify);
            EXPECT_EQ(fast.cycles, verified.cycles);
            EXPECT_EQ(fast.hits, verified.hits);
            EXPECT_EQ(fast.tests, verified.tests);
            EXPECT_EQ(fast.link, verified.link);
            EXPECT_EQ(fast.time, verified.time);
            for (std::size_t i = 0; i < fast.units.size(); ++i)
                EXPECT_EQ(fast.units[i].cycles, verified.units[i].cycles) << fast.units[i].name;
        }
    }
}

TEST(Stream, MoreTestsThanTheWatchdogHasCyclesAreProgress) {
    const Work work = make_work(100, 20);
    sim::Config config;
    config.watchdog_cycles = 100'000;
    config.rtu.pair.ii_cycles = 1000;
    const StreamResult result = sim::simulate_stream(config, job_of(work, StreamMode::Batched, 2000));
    EXPECT_GT(result.cycles, 1'900'000U);
}

}  // namespace
}  // namespace rtu::test
