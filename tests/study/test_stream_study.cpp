#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "study/stream/stream_balance.hpp"
#include "study/stream/stream_input.hpp"
#include "study/stream/stream_output.hpp"
#include "study/stream/stream_published.hpp"
#include "study/stream/stream_study.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::study {
namespace {

using sim::ReadBack;
using sim::StreamMode;

// Lone triangles, and rays between two points of their box.
StreamInput make_input(std::uint32_t ray_count, std::uint32_t triangle_count) {
    test::Random random(1);
    const model::TriangleMesh mesh = test::triangle_soup(triangle_count, 2, 0.3F);
    StreamInput input;
    input.scene.name = "soup";
    input.pairing.method = "none";
    const auto pairing =
        model::pair_triangles(mesh, {model::PairingKind::None, 0}, model::EdgeIdentity::Position);
    for (const model::TrianglePair& pair : pairing.pairs)
        input.pairs.push_back(model::make_leaf_pair(pair, mesh.positions));
    for (std::uint32_t i = 0; i < ray_count; ++i) {
        const model::Vec3 from = random.point(0, 1), to = random.point(0, 1);
        input.rays.push_back({from, 0, to - from, 1});
    }
    return input;
}

LinkedMachine machine_of(const std::string& link, const std::string& preset = "default",
                         const std::vector<std::string>& sets = {}) {
    return {link, sim::load_config(preset, {}, sets, link).config};
}

double rate(const std::vector<PublishedStream>& streams, const std::string& what) {
    const auto found = std::ranges::find(streams, what, &PublishedStream::what);
    EXPECT_NE(found, streams.end()) << what;
    return found->row.tests_per_second();
}

class AsPublished : public testing::Test {
  protected:
    AsPublished()
        : input_(make_input(1024, 48)),
          streams_(published_streams(input_, published_options({}).machines.front())) {}
    StreamInput input_;
    std::vector<PublishedStream> streams_;
};

TEST_F(AsPublished, DirectPassingIsTwoOrdersBelowBatches) {
    const double direct = rate(streams_, "direct passing");
    EXPECT_NEAR(direct / 7e4, 1, 0.02) << "fitted";
    const double ratio = rate(streams_, "textures of 32 x 32") / direct;
    EXPECT_GT(ratio, 40);
    EXPECT_LT(ratio, 100);
}

TEST_F(AsPublished, TexturesOf32By32AreTheBestAndWithinATenthOfTheRate) {
    const double best = rate(streams_, "textures of 32 x 32");
    for (const PublishedStream& stream : streams_) {
        if (stream.what.starts_with("textures")) {
            EXPECT_LE(stream.row.tests_per_second(), best) << stream.what;
        }
    }
    EXPECT_NEAR(best / 4e6, 1, 0.1);
}

TEST_F(AsPublished, MixedModeIsTheBestAndMeetsTheRateWithoutReadBack) {
    const double mixed = rate(streams_, "mixed mode, 1024 rays");
    EXPECT_GT(mixed, rate(streams_, "textures of 32 x 32"));
    EXPECT_GT(mixed, rate(streams_, "mixed mode, 256 rays"));
    EXPECT_GT(rate(streams_, "mixed mode, 256 rays"), rate(streams_, "mixed mode, 64 rays"));
    EXPECT_NEAR(rate(streams_, "mixed mode, 1024 rays, no read-back") / 8e6, 1, 0.06) << "fitted";
}

TEST_F(AsPublished, ReadBackCostsMoreThanUpload) {
    for (const PublishedStream& stream : streams_) {
        if (!stream.what.starts_with("textures")) continue;
        EXPECT_GT(stream.row.result.time.read_back_cycles, stream.row.result.time.upload_cycles)
            << stream.what;
    }
    const auto found = std::ranges::find(streams_, "mixed mode, 1024 rays", &PublishedStream::what);
    EXPECT_GT(found->row.result.time.read_back_cycles, 5 * found->row.result.time.upload_cycles);
}

TEST(StreamBalance, ClosedFormIsABoundThatTheSimulationMeets) {
    const StreamInput input = make_input(256, 64);
    StreamRunner runner(input);
    for (const std::string link : {"agp_8x", "pcie3_x16", "pcie5_x16", "on_chip"}) {
        for (const StreamMode mode : {StreamMode::Batched, StreamMode::Mixed, StreamMode::Resident}) {
            for (const std::uint64_t batch : {64U, 256U, 512U}) {
                const LinkedMachine machine = machine_of(link, "default", {"rtu.pair.ii_cycles=20"});
                const ReadBack read_back = usual_read_back(mode);
                const StreamRow row = runner.run(machine, mode, read_back, batch);
                const BatchTimes times =
                    batch_times(machine.config, runner.job(machine, mode, read_back, batch), 20);
                const double alone =
                    times.host + times.upload + times.read_back + times.latency + times.machine;
                // The first batch from end to end, then one a period.
                const double expected =
                    alone + double(row.result.batch_count - 1) * times.period(machine.config.link);
                // Nothing is faster; parts that overlap and take about as long get in each other's way.
                const bool is_close = machine.config.link.buffers > 1 && times.machine > times.host / 2;
                EXPECT_GT(double(row.result.cycles) / expected, 0.99);
                EXPECT_LT(double(row.result.cycles) / expected, is_close ? 1.12 : 1.03)
                    << to_string(mode) << " over " << link << " by " << batch;
            }
        }
    }
}

TEST(StreamBalance, IsWhereTheTestersTakeAsLongAsTheLink) {
    const StreamInput input = make_input(256, 256);
    StreamRunner runner(input);
    const LinkedMachine machine = machine_of("pcie5_x16", "default", {"rtu.pair.ii_cycles=4"});
    const sim::StreamJob job = runner.job(machine, StreamMode::Batched, ReadBack::Tests, 1);
    const auto balance = balance_batch(machine.config, job, 4);
    ASSERT_TRUE(balance);
    // A batch has two calls of 6 us, so 65,536 tests of 4 ns are enough for 21 batches.
    EXPECT_EQ(*balance, (65'536 + 20) / 21);
    const auto limit = [&](std::uint64_t batch) {
        return runner.run(machine, StreamMode::Batched, ReadBack::Tests, batch).limit();
    };
    EXPECT_EQ(limit(*balance / 2), "host");
    EXPECT_EQ(limit(*balance * 2), "testers");
    const LinkedMachine fast = machine_of("pcie5_x16");
    EXPECT_FALSE(balance_batch(fast.config, job, 1)) << "68 bytes a test at 57.6 bytes a cycle: never";
    const LinkedMachine none = machine_of("agp_8x");
    EXPECT_FALSE(balance_batch(none.config, job, 1));
}

TEST(StreamStudy, OverlappedStreamsHaveABestBatchWithinTheirSize) {
    const StreamInput input = make_input(256, 256);
    StreamRunner runner(input);
    const LinkedMachine machine = machine_of("pcie4_x16", "default", {"rtu.pair.ii_cycles=4"});
    const auto rate_of = [&](std::uint64_t batch) {
        return runner.run(machine, StreamMode::Batched, ReadBack::Tests, batch).tests_per_second();
    };
    EXPECT_GT(rate_of(4096), 1.5 * rate_of(256)) << "too many calls";
    EXPECT_GT(rate_of(4096), 1.2 * rate_of(65536)) << "nothing to overlap with";
}

StreamReport small_report() {
    StreamOptions options;
    options.ray_count = 20;
    options.pair_count = 30;
    options.modes = {StreamMode::Direct, StreamMode::Mixed};
    options.machines = {machine_of("agp_8x"), machine_of("on_chip"), machine_of("none")};
    options.batches = {8, 300};
    return run_stream_study(options);
}

// What is left is what comes before the first batch and behind the last.
TEST(StreamStudy, TakesATimeLinearInItsTests) {
    const StreamInput few = make_input(512, 64), many = make_input(2048, 64);
    StreamRunner run_few(few), run_many(many);
    for (const std::string link : {"agp_8x", "pcie4_x16"}) {
        for (const StreamMode mode : {StreamMode::Direct, StreamMode::Batched, StreamMode::Mixed}) {
            const std::uint64_t batch = mode == StreamMode::Direct ? 1 : 256;
            const auto cycles = [&](StreamRunner& runner) {
                return double(runner.run(machine_of(link), mode, ReadBack::Tests, batch).result.cycles);
            };
            EXPECT_NEAR(cycles(run_many) / cycles(run_few), 4, 0.04) << link << ' ' << int(mode);
        }
    }
}

TEST(StreamStudy, ReportsEveryModeLinkAndBatch) {
    const StreamReport report = small_report();
    EXPECT_EQ(report.ray_count, 20U);
    EXPECT_EQ(report.pair_count, 30U);
    EXPECT_GE(report.rows.size(), 3U + 6U);
    EXPECT_EQ(report.balances.size(), 6U);
    for (const StreamRow& row : report.rows) {
        EXPECT_EQ(row.result.tests.pair_tests, 600U);
        EXPECT_LE(row.tests_per_second(), 1.001 * row.alone_tests_per_second());
        if (row.link == "none") {
            EXPECT_EQ(row.alone_cycles, row.result.cycles);
        }
    }
}

TEST(StreamStudy, WritesTextJsonAndCsvOfTheSameRows) {
    const StreamReport report = small_report();
    const std::string text = stream_text(report);
    EXPECT_THAT(text, testing::HasSubstr("Each mode on each link with its best batch"));
    EXPECT_THAT(text, testing::HasSubstr("Rate by batch size, mixed"));
    const auto json = nlohmann::json::parse(stream_json(report));
    ASSERT_EQ(json["rows"].size(), report.rows.size());
    for (const auto& row : json["rows"]) {
        const std::uint64_t shares =
            row["machine_cycles"].get<std::uint64_t>() + row["read_back_cycles"].get<std::uint64_t>() +
            row["upload_cycles"].get<std::uint64_t>() + row["waiting_cycles"].get<std::uint64_t>();
        EXPECT_EQ(shares, row["cycles"]);
        EXPECT_EQ(row["units"]["link"]["counters"]["up_bytes"],
                  row["units"]["link"]["counters"]["up_bytes_arrived"]);
    }
    const std::string csv = stream_csv(report);
    EXPECT_EQ(std::size_t(std::ranges::count(csv, '\n')), report.rows.size() + 1);
    EXPECT_THAT(csv, testing::HasSubstr("testers.pair_tests [tests]"));
}

TEST(StreamStudy, IsTheSameTwice) { EXPECT_EQ(stream_json(small_report()), stream_json(small_report())); }

}  // namespace
}  // namespace rtu::study
