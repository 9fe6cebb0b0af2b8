#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/scenes.hpp"
#include "tests/traces/trace_examples.hpp"
#include "traces/npy_header.hpp"
#include "traces/ray_files.hpp"

namespace rtu::test {
namespace {

using testing::HasSubstr;
using traces::RayChunk;
using traces::RayFormat;

class RayFiles : public testing::Test {
  protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    // Through a file of the format and back.
    std::vector<RayChunk> round_trip(const std::string& name, const std::vector<RayChunk>& chunks) const {
        const auto writer = create_rays(path(name), traces::format_of_output(path(name)), example_header());
        for (const RayChunk& chunk : chunks) writer->add(chunk);
        writer->finish();
        return read(name);
    }
    std::vector<RayChunk> read(const std::string& name, const traces::ImportOptions& options = {}) const {
        const auto reader = open_rays(path(name), traces::format_of_input(path(name)), options);
        std::vector<RayChunk> chunks;
        while (const auto chunk = reader->next()) {
            if (!chunks.empty() && chunks.back().workload == chunk->workload) {
                EXPECT_EQ(chunk->first_ray, chunks.back().rays.size());
                auto& rays = chunks.back().rays;
                rays.insert(rays.end(), chunk->rays.begin(), chunk->rays.end());
                chunks.back().ids.insert(chunks.back().ids.end(), chunk->ids.begin(), chunk->ids.end());
            } else {
                chunks.push_back(*chunk);
            }
        }
        return chunks;
    }
    std::string fault(const std::string& name, std::string_view bytes) const {
        static_cast<void>(folder_.write(name, bytes));
        return error_of([&] { static_cast<void>(read(name)); });
    }
    TemporaryFolder folder_;
};

RayChunk plain(std::vector<model::Ray> rays) {
    return {"rays", model::RayKind::ClosestHit, traces::IdKind::None, 0, std::move(rays), {}};
}

TEST_F(RayFiles, EveryFormatKeepsEveryBit) {
    const RayChunk chunk = plain(odd_rays(40000, 9));
    for (const char* name : {"a.rays8", "a.npy", "a.csv", "a.jsonl", "a.rtutrace"}) {
        SCOPED_TRACE(name);
        expect_equal(round_trip(name, {chunk}), {chunk});
    }
    RayChunk without_t_min = chunk;
    for (model::Ray& ray : without_t_min.rays) ray.t_min = 0;
    expect_equal(round_trip("a.rays7", {without_t_min}), {without_t_min});
}

TEST_F(RayFiles, TextFormatsKeepWorkloadsKindsAndIds) {
    auto chunks = example_chunks(30, 20);
    chunks.pop_back();  // text has no line for a workload without rays
    expect_equal(round_trip("a.jsonl", chunks), chunks);
    chunks[1].id_kind = traces::IdKind::Pixel;  // one column of ids
    expect_equal(round_trip("a.csv", chunks), chunks);
}

TEST_F(RayFiles, RawRaysAreAsDescribed) {
    const float values[] = {1, 2, 3, 4, 5, 6, 7, 8};
    const std::string_view bytes(reinterpret_cast<const char*>(values), sizeof values);
    static_cast<void>(folder_.write("a.rays8", bytes));
    EXPECT_EQ(read("a.rays8").front().rays.front(), (model::Ray{{1, 2, 3}, 4, {5, 6, 7}, 8}));
    static_cast<void>(folder_.write("a.rays7", bytes.substr(0, 28)));
    EXPECT_EQ(read("a.rays7").front().rays.front(), (model::Ray{{1, 2, 3}, 0, {4, 5, 6}, 7}));
    EXPECT_THAT(fault("a.rays7", bytes), HasSubstr("byte 28: expected rays of 28 bytes, found 4"));
    const auto any = read("a.rays8", {"shadow", model::RayKind::AnyHit});
    EXPECT_EQ(any.front().workload, "shadow");
    EXPECT_EQ(any.front().kind, model::RayKind::AnyHit);
}

TEST_F(RayFiles, WhatAFormatCannotHoldIsRefusedAndLeavesNoFile) {
    const auto chunks = example_chunks(3, 3);
    EXPECT_THAT(error_of([&] { round_trip("a.rays8", {chunks[0], chunks[1]}); }), HasSubstr("--workload"));
    EXPECT_THAT(error_of([&] { round_trip("a.rays7", {chunks[0]}); }), HasSubstr("ray 0 has t_min"));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(RayFiles, OtherArraysThanRaysAreRefused) {
    const auto npy = [&](std::string_view dictionary, std::size_t data_bytes) {
        std::string bytes("\x93NUMPY\x01\x00", 8);
        bytes += char(dictionary.size());
        bytes += '\0';
        return bytes + std::string(dictionary) + std::string(data_bytes, '\0');
    };
    EXPECT_EQ(fault("a.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8), }\n", 64)), "");
    EXPECT_THAT(
        fault("a.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 8), }", 128)),
        HasSubstr("descr: expected '<f4' (numpy.float32, little-endian), got '<f8'; numpy: rays.astype"));
    EXPECT_THAT(fault("a.npy", npy("{'descr': '>f4', 'fortran_order': False, 'shape': (2, 8), }", 64)),
                HasSubstr("got '>f4'"));
    EXPECT_THAT(fault("a.npy", npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 8), }", 64)),
                HasSubstr("fortran_order: expected False (C order), got True"));
    for (const char* shape : {"(16,)", "(2, 7)", "(2, 8, 1)", "()", "(2,8)", "(-2, 8)"}) {
        EXPECT_THAT(
            fault("a.npy",
                  npy(fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': {}, }}", shape), 64)),
            HasSubstr(fmt::format("shape: expected (ray_count, 8), got {}", shape)));
    }
    EXPECT_THAT(fault("a.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 8), }", 64)),
                HasSubstr("expected 3 rays, found 2"));
    EXPECT_THAT(fault("a.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8), }", 63)),
                HasSubstr("found 31 bytes after the last"));
    EXPECT_THAT(fault("a.npy", npy("{'descr': '<f4', 'shape': (2, 8), }", 64)), HasSubstr("expected descr"));
    EXPECT_THAT(fault("a.npy", npy("{'descr': [('x', '<f4')], 'shape': (2, 8), }", 64)), HasSubstr("descr"));
    EXPECT_THAT(fault("a.npy", "\x93NUMPY\x09"), HasSubstr("a.npy: expected 1 more bytes"));
    EXPECT_THAT(fault("a.npy", "NUMPY"), HasSubstr("a.npy: "));
}

TEST_F(RayFiles, CsvErrorsNameLineAndColumn) {
    const std::string names = "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z";
    static_cast<void>(folder_.write("a.csv", names + "\r\n1,2,3,4,5,6\r\n\r\n"));
    EXPECT_EQ(read("a.csv").front().rays.front(),
              (model::Ray{{1, 2, 3}, 0, {4, 5, 6}, std::numeric_limits<float>::infinity()}));
    EXPECT_THAT(fault("a.csv", names + "\n1,2,3,4,5,6\n1,2,x,4,5,6\n"),
                HasSubstr("a.csv:3: origin_z: expected a number, got 'x'"));
    EXPECT_THAT(fault("a.csv", names + "\n1,2,3\n"), HasSubstr("a.csv:2: expected 6 cells, got 3"));
    EXPECT_THAT(fault("a.csv", "origin_x,height\n"), HasSubstr("a.csv:1: unknown column 'height'"));
    EXPECT_THAT(fault("a.csv", "origin_x\n"), HasSubstr("a.csv:1: expected a column origin_y"));
    EXPECT_THAT(fault("a.csv", names + ",t_min,t_min\n"), HasSubstr("t_min is there twice"));
    EXPECT_THAT(fault("a.csv", names + ",t_max\n1,2,3,4,5,6,1e99\n"), HasSubstr("t_max: expected a number"));
    EXPECT_THAT(fault("a.csv", names + ",kind\n1,2,3,4,5,6,both\n"), HasSubstr("expected closest or any"));
    EXPECT_THAT(fault("a.csv", names + ",workload\n1,2,3,4,5,6,a b\n"), HasSubstr("workload: expected"));
    EXPECT_THAT(fault("a.csv", names + ",pixel\n1,2,3,4,5,6,-1\n"), HasSubstr("pixel: expected"));
    EXPECT_THAT(fault("a.csv", names + "\n" + std::string(200'000, '1')),
                HasSubstr("a.csv:2: expected lines"));
}

TEST_F(RayFiles, JsonErrorsNameLineAndKey) {
    const std::string good = R"({"origin": [1, 2, 3], "direction": [4, 5, 6.5], "t_max": "inf"})";
    static_cast<void>(folder_.write("a.jsonl", good + "\n\n" + good));
    EXPECT_EQ(read("a.jsonl").front().rays.back(),
              (model::Ray{{1, 2, 3}, 0, {4, 5, 6.5F}, std::numeric_limits<float>::infinity()}));
    const auto fault_of = [&](const char* line) { return fault("a.jsonl", good + "\n" + line); };
    EXPECT_THAT(fault_of("{"), HasSubstr("a.jsonl:2: column 2: not JSON"));
    EXPECT_THAT(fault_of("[1]"), HasSubstr("a.jsonl:2: expected an object"));
    EXPECT_THAT(fault_of("{}"), HasSubstr("a.jsonl:2: expected the key 'origin'"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2], "direction": [1, 2, 3]})"),
                HasSubstr("origin: expected an array"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2, "x"], "direction": [1, 2, 3]})"),
                HasSubstr("origin: expected a number"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2, 1e40], "direction": [1, 2, 3]})"),
                HasSubstr("number of binary32"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2, 3], "direction": [1, 2, 3], "tmax": 1})"),
                HasSubstr("unknown key 'tmax'"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2, 3], "direction": [1, 2, 3], "origin": [1, 2, 3]})"),
                HasSubstr("twice"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2, 3], "direction": [1, 2, 3], "pixel": 4294967296})"),
                HasSubstr("below 2^32"));
    EXPECT_THAT(fault_of(R"({"origin": [1, 2, 3], "direction": [1, 2, 3], "pixel": 1, "parent": 2})"),
                HasSubstr("one id"));
    std::string deep;
    for (int i = 0; i < 20000; ++i) deep += '[';
    EXPECT_NE(fault_of(deep.c_str()), "");
}

TEST_F(RayFiles, UnknownFormatsAreNamed) {
    EXPECT_THAT(fault("a.rays9", ""), HasSubstr(".rays7, .rays8"));
    EXPECT_THAT(error_of([] { static_cast<void>(traces::parse_ray_format("tiff")); }), HasSubstr("tiff"));
    write_trace(path("misnamed.csv"), example_chunks(3, 0));
    EXPECT_EQ(traces::format_of_input(path("misnamed.csv")), RayFormat::Trace);
}

TEST_F(RayFiles, ReadsTheRaysOfAnotherSimulator) {
    const auto file = scene_file("cornell_dragon_primary_256.rays7");
    if (!file) GTEST_SKIP() << "no real scenes here: set RTUSIM_SCENES to their folder";
    const auto reader = open_rays(*file, RayFormat::Rays7);
    std::uint64_t rays = 0;
    while (const auto chunk = reader->next()) {
        for (const model::Ray& ray : chunk->rays) EXPECT_NEAR(length(ray.direction), 1, 1e-3);
        rays += chunk->rays.size();
    }
    EXPECT_EQ(rays, 65536U);
}

}  // namespace
}  // namespace rtu::test
