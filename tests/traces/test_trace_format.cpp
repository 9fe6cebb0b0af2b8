#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/traces/trace_examples.hpp"
#include "traces/recover.hpp"

namespace rtu::test {
namespace {

using traces::RayChunk;
using traces::TraceReader;
using traces::TraceWriter;

class TraceFormat : public testing::Test {
  protected:
    std::filesystem::path path(const std::string& name = "a.rtutrace") const { return folder_.path() / name; }
    TemporaryFolder folder_;
};

TEST_F(TraceFormat, KeepsEveryBitOfEveryRay) {
    for (const std::uint32_t count : {0U, 1U, 16384U, 40000U}) {
        const auto chunks = example_chunks(count, 100);
        write_trace(path(), chunks);
        expect_equal(read_trace(path()), chunks);
    }
}

TEST_F(TraceFormat, KeepsItsHeader) {
    write_trace(path(), example_chunks(3, 2));
    const traces::TraceHeader header = TraceReader(path()).header();
    EXPECT_EQ(encode(header), encode(example_header()));
    EXPECT_EQ(header.scene_hash, 0x1234U);
    EXPECT_EQ(header.picture->camera.target, (Vec3{4, 5, 6}));
    EXPECT_EQ(header.picture->seed, 77U);
    const traces::TraceSurvey survey = traces::survey_trace(path());
    EXPECT_FALSE(survey.fault);
    EXPECT_EQ(survey.workloads,
              (std::vector<traces::WorkloadCount>{{"primary", model::RayKind::ClosestHit, 3},
                                                  {"shadow", model::RayKind::AnyHit, 2},
                                                  {"none", model::RayKind::AnyHit, 0}}));
}

TEST_F(TraceFormat, DoesNotDependOnHowTheRaysWereHandedOver) {
    const auto chunks = example_chunks(20000, 1);
    write_trace(path("whole"), chunks);
    std::vector<RayChunk> pieces;
    for (const RayChunk& chunk : chunks) {
        for (std::size_t begin = 0; begin <= chunk.rays.size(); begin += 777) {
            const std::size_t end = std::min(begin + 777, chunk.rays.size());
            RayChunk& piece = pieces.emplace_back(chunk);
            piece.rays.assign(chunk.rays.begin() + std::ptrdiff_t(begin),
                              chunk.rays.begin() + std::ptrdiff_t(end));
            if (!chunk.ids.empty()) {
                piece.ids.assign(chunk.ids.begin() + std::ptrdiff_t(begin),
                                 chunk.ids.begin() + std::ptrdiff_t(end));
            }
        }
    }
    write_trace(path("pieces"), pieces);
    EXPECT_EQ(bytes_of(path("whole")), bytes_of(path("pieces")));
}

// The numbers of traces/trace_reader.hpp, at the offsets that it gives.
TEST_F(TraceFormat, IsAsDescribed) {
    const auto chunks = example_chunks(2, 0);
    write_trace(path(), {chunks[0]});
    const std::string bytes = bytes_of(path());
    EXPECT_EQ(bytes.substr(0, 16), std::string("\x89RtuTr\r\n\x04\x03\x02\x01\x01\0\0\0", 16));
    EXPECT_EQ(bytes.substr(16, 5), "RtBk\x01");
    const auto u32 = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t(std::uint8_t(bytes[at + i])) << (8 * i);
        return value;
    };
    const std::size_t chunk = 16 + 40 + u32(16 + 8);
    EXPECT_EQ(bytes.substr(chunk, 5), "RtBk\x02");
    EXPECT_EQ(u32(chunk + 12), 48U + 2 * 36);
    const traces::BlockFrame frame = traces::decode_frame(std::string_view(bytes).substr(chunk, 40));
    const std::string payload =
        decode_payload(frame, std::string_view(bytes).substr(chunk + 40, frame.stored_bytes));
    EXPECT_EQ(payload.substr(0, 8), std::string("primary\0", 8));
    EXPECT_EQ(payload.substr(32, 6), std::string("\x02\x00\x00\x00\x00\x01", 6));
    // The last column: ids 0 and 3, lowest bytes first.
    EXPECT_EQ(payload.substr(48 + 64), std::string("\x00\x03\x00\x00\x00\x00\x00\x00", 8));
    const std::size_t end = chunk + 40 + u32(chunk + 8);
    EXPECT_EQ(bytes.substr(end, 5), "RtBk\x04");
    EXPECT_EQ(end + 40 + u32(end + 8), bytes.size());
}

TEST_F(TraceFormat, RefusesWorkloadsThatComeAgainOrChangeTheirKind) {
    const auto chunks = example_chunks(3, 3);
    EXPECT_THAT(error_of([&] {
                    write_trace(path(), {chunks[0], chunks[1], chunks[0]});
                }),
                testing::HasSubstr("'primary' comes again"));
    RayChunk other = chunks[0];
    other.kind = model::RayKind::AnyHit;
    EXPECT_THAT(error_of([&] { write_trace(path(), {chunks[0], other}); }), testing::HasSubstr("both kinds"));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));  // a refused trace leaves nothing
}

TEST_F(TraceFormat, KeepsTraversals) {
    const auto image = image_of(triangle_soup(300, 5, 0.2F), {4, 3});
    traces::TraceHeader header = example_header();
    header.content = traces::TraceContent::Visits;
    header.image = traces::image_facts(image);
    RayChunk rays{"primary", model::RayKind::ClosestHit, traces::IdKind::None, 0, odd_rays(3000, 3), {}};
    const auto recorded = record_visits(rays, image);
    TraceWriter writer(path(), header);
    for (const auto& chunk : recorded) writer.add(chunk);
    writer.finish();
    TraceReader reader(path());
    EXPECT_EQ(reader.header().image, header.image);
    for (const auto& chunk : recorded) {
        const auto read = reader.next_visits();
        ASSERT_TRUE(read);
        EXPECT_EQ(encode(*read), encode(chunk));
    }
    EXPECT_FALSE(reader.next_visits());
    EXPECT_EQ(reader.counts().front().ray_count, 3000U);
    EXPECT_THAT(error_of([&] { static_cast<void>(TraceReader(path()).next_rays()); }),
                testing::HasSubstr("expected a trace of rays"));
}

}  // namespace
}  // namespace rtu::test
