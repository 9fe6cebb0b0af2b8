#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "tests/traces/trace_examples.hpp"
#include "traces/block.hpp"
#include "traces/recover.hpp"

namespace rtu::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using traces::BlockKind;
using traces::TraceReader;

// A folder in memory where there is one: these tests write thousands of files.
class FastFolder {
  public:
    FastFolder()
        : path_(std::filesystem::path(std::filesystem::is_directory("/dev/shm") ? "/dev/shm"
                                                                                : testing::TempDir()) /
                fmt::format("rtusim_trace_faults_{}", ::getpid())) {
        std::filesystem::create_directories(path_);
    }
    FastFolder(const FastFolder&) = delete;
    FastFolder& operator=(const FastFolder&) = delete;
    ~FastFolder() { std::filesystem::remove_all(path_); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

// A small trace of two chunks, and what its damaged copies give.
class TraceFaults : public testing::Test {
  protected:
    TraceFaults() : chunks_(example_chunks(3, 2)) {
        chunks_.pop_back();
        write_trace(path("good"), chunks_);
        good_ = bytes_of(path("good"));
    }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    // What reading says of these bytes.
    std::string fault(const std::string& bytes) const {
        static_cast<void>(folder_.write("bad", bytes));
        return error_of([&] {
            TraceReader reader(path("bad"));
            while (reader.next_rays()) continue;
        });
    }
    std::vector<traces::RayChunk> recovered(const std::string& bytes) const {
        static_cast<void>(folder_.write("bad", bytes));
        static_cast<void>(traces::recover_trace(path("bad"), path("saved")));
        return read_trace(path("saved"));
    }
    // The parts of good_: preamble, header, two chunks, end.
    std::vector<std::size_t> block_offsets() const {
        std::vector<std::size_t> offsets;
        for (std::size_t at = 16; at < good_.size();) {
            offsets.push_back(at);
            at += 40 + traces::decode_frame(std::string_view(good_).substr(at, 40)).stored_bytes;
        }
        return offsets;
    }
    // A trace of other blocks, with right checksums.
    static std::string forged(const std::vector<std::pair<BlockKind, std::string>>& blocks) {
        std::string bytes = traces::preamble();
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            bytes += traces::encode_block(blocks[i].first, i, blocks[i].second);
        }
        return bytes;
    }

    FastFolder folder_;
    std::vector<traces::RayChunk> chunks_;
    std::string good_;
};

TEST_F(TraceFaults, EveryFlippedByteIsOneErrorWithItsOffset) {
    EXPECT_EQ(fault(good_), "");
    const std::vector<std::size_t> offsets = block_offsets();
    for (std::size_t i = 0; i < good_.size(); ++i) {
        // The block in which the byte lies: the preamble is reported at 0.
        const auto next = std::upper_bound(offsets.begin(), offsets.end(), i);
        const std::size_t block = next == offsets.begin() ? 0 : *(next - 1);
        for (const int mask : {1 << (i % 8), 255}) {
            std::string bad = good_;
            bad[i] = char(bad[i] ^ mask);
            ASSERT_THAT(fault(bad), HasSubstr("bad: byte " + std::to_string(block) + ": "))
                << "byte " << i << " mask " << mask;
        }
    }
}

TEST_F(TraceFaults, WhateverByteIsDamagedTheOtherChunksAreSaved) {
    const std::vector<std::size_t> offsets = block_offsets();
    ASSERT_EQ(offsets.size(), 4U);
    for (std::size_t i = 0; i < good_.size(); ++i) {
        std::string bad = good_;
        bad[i] = char(bad[i] ^ 0x55);
        std::vector<traces::RayChunk> expected = chunks_;
        if (i >= offsets[1] && i < offsets[2]) expected.erase(expected.begin());
        if (i >= offsets[2] && i < offsets[3]) expected.pop_back();
        ASSERT_NO_FATAL_FAILURE(expect_equal(recovered(bad), expected)) << "byte " << i;
        ASSERT_EQ(TraceReader(path("saved")).header().scene_hash, 0x1234U) << "byte " << i;
    }
}

TEST_F(TraceFaults, EveryTruncationIsAnErrorAndKeepsTheChunksBefore) {
    const std::vector<std::size_t> offsets = block_offsets();
    for (std::size_t size = 0; size < good_.size(); ++size) {
        const std::string bad = good_.substr(0, size);
        ASSERT_THAT(fault(bad), ContainsRegex("bad: byte [0-9]+: ")) << size;
        std::vector<traces::RayChunk> expected = chunks_;
        if (size < offsets[3]) expected.pop_back();
        if (size < offsets[2]) continue;
        ASSERT_NO_FATAL_FAILURE(expect_equal(recovered(bad), expected)) << size;
    }
    EXPECT_THAT(fault(good_.substr(0, offsets[3])), HasSubstr("interrupted recording"));
    EXPECT_THAT(error_of([&] { recovered(good_.substr(0, offsets[1])); }), HasSubstr("no"));
}

TEST_F(TraceFaults, WhatFollowsTheEndIsAnError) {
    EXPECT_THAT(fault(good_ + "x"), HasSubstr(fmt::format("byte {}: expected the end", good_.size())));
    EXPECT_THAT(fault(good_ + good_), HasSubstr("expected the end"));
    expect_equal(recovered("rubbish RtBk before" + good_ + "and behind"), chunks_);
}

TEST_F(TraceFaults, VersionByteOrderAndForeignFilesAreNamed) {
    std::string bad = good_;
    bad[12] = 2;
    EXPECT_THAT(fault(bad), HasSubstr("byte 0: expected a trace of version 1, got version 2"));
    bad = good_;
    std::reverse(bad.begin() + 8, bad.begin() + 12);
    EXPECT_THAT(fault(bad), HasSubstr("byte 0: a trace in big-endian byte order, expected little-endian"));
    EXPECT_THAT(fault(std::string(100, '\0')), HasSubstr("byte 0: not a trace"));
    EXPECT_THAT(fault(""), HasSubstr("byte 0: expected 8 more bytes, found 0"));
}

TEST_F(TraceFaults, CountsThatLieAreFound) {
    const std::string header = encode(example_header()), chunk = encode(chunks_[0]);
    const auto end = [&](std::uint64_t blocks, std::uint64_t rays) {
        return encode(
            traces::TraceEnd{example_header(), blocks, {{"primary", model::RayKind::ClosestHit, rays}}});
    };
    const auto trace = [&](const std::string& rays, const std::string& last) {
        return fault(forged({{BlockKind::Header, header}, {BlockKind::Rays, rays}, {BlockKind::End, last}}));
    };
    EXPECT_EQ(trace(chunk, end(3, 3)), "");
    EXPECT_THAT(trace(chunk, end(3, 4)), HasSubstr("expected 4 rays of 'primary', got 3"));
    EXPECT_THAT(trace(chunk, end(4, 3)), HasSubstr("expected 4 blocks, got 3"));
    std::string lie = chunk;
    lie[32] = 4;  // one ray more than there are
    EXPECT_THAT(trace(lie, end(3, 4)), HasSubstr("more bytes"));
    lie[32] = 2;
    EXPECT_THAT(trace(lie, end(3, 2)), HasSubstr("expected the end of the block"));
    lie = chunk;
    lie[34] = 1;  // 65,539 rays
    EXPECT_THAT(trace(lie, end(3, 5)), HasSubstr("at most 65536 rays"));
    lie = chunk;
    lie[40] = 1;
    EXPECT_THAT(trace(lie, end(3, 4)), HasSubstr("expected ray 0 next, got 1"));
    lie = chunk;
    lie[36] = 2;
    EXPECT_THAT(trace(lie, end(3, 4)), HasSubstr("ray kind"));
    traces::TraceHeader other = example_header();
    other.scene_hash = 1;
    EXPECT_THAT(trace(chunk, encode(traces::TraceEnd{other, 3, {}})), HasSubstr("the header once more"));
    EXPECT_THAT(fault(forged({{BlockKind::Rays, chunk}})), HasSubstr("byte 16: expected the header block"));
    EXPECT_THAT(fault(forged({{BlockKind::Header, header}, {BlockKind::Visits, chunk}})),
                HasSubstr("expected a chunk of the header's content"));
}

TEST_F(TraceFaults, BlocksThatAreMissingOrInAnotherOrderAreFound) {
    const std::vector<std::size_t> at = block_offsets();
    const std::string first = good_.substr(at[1], at[2] - at[1]), second = good_.substr(at[2], at[3] - at[2]);
    EXPECT_THAT(fault(good_.substr(0, at[1]) + second + first + good_.substr(at[3])),
                HasSubstr(fmt::format("byte {}: expected block 1, got block 2", at[1])));
    EXPECT_THAT(fault(good_.substr(0, at[2]) + good_.substr(at[3])),
                HasSubstr(fmt::format("byte {}: expected block 2, got block 3", at[2])));
}

TEST_F(TraceFaults, AFullDeviceIsNamedWithItsOffset) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_THAT(error_of([&] { write_trace("/dev/full", chunks_); }),
                HasSubstr("/dev/full: byte 0: cannot write: No space left on device"));
}

TEST_F(TraceFaults, AnUnfinishedTraceOfAnotherProcessIsNotOverwritten) {
    static_cast<void>(folder_.write("new.partial", "precious"));
    EXPECT_THAT(error_of([&] { write_trace(path("new"), chunks_); }),
                HasSubstr("new.partial: is there already"));
    EXPECT_EQ(bytes_of(path("new.partial")), "precious");
    EXPECT_FALSE(std::filesystem::exists(path("new")));
}

}  // namespace
}  // namespace rtu::test
