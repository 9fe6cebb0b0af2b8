#pragma once

// The trace format, version 1. All numbers are little-endian; f32 is IEEE binary32; offsets are in bytes.
//
//   trace     preamble, header block, any number of chunk blocks, end block; nothing follows
//   preamble   0  8 bytes  89 52 74 75 54 72 0d 0a   ("RtuTr" between bytes that a text transfer would
//   change)
//              8  u32      0x01020304                (byte order)
//             12  u16      1                         (version)
//             14  u16      0
//
// A block is a frame of 40 bytes and its payload:
//   frame      0  4 bytes  "RtBk"
//              4  u8       kind: 1 header, 2 rays, 3 visits, 4 end
//              5  u8       codec of the payload: 0 none, 1 zstd (one frame, with its content size)
//              6  u16      0
//              8  u32      bytes of the payload in the file, not more than:
//             12  u32      bytes of the payload after decompression, at most 2^28
//             16  u64      index of the block in its file, from 0
//             24  u64      XXH64 of the payload as it is in the file, seed 1 (the version)
//             32  u64      XXH64 of the 32 bytes before, seed 1
//   So every bit of a file is either fixed or under a checksum, and behind a damaged block the next one is
//   found by its first bytes and its checksum.
//
// Payload of the header block ("text": u16 length, at most 1024, and that many bytes):
//              0  u8       content: 1 rays, 2 visits
//              1  u8       bit 0: made for a scene; bit 1: has a picture
//              2  6 bytes  0
//              8  u64      scene hash: model::fingerprint() of the mesh; of no meaning without bit 0
//             16  text     name of the scene; text generator
//   picture    u64 seed; u32 width, height in pixels; f32 camera: eye[3], target[3], up[3], tan_half_fov;
//              text source of the camera
//   visits     u64 fingerprint of the memory image; u64 its bytes; u64 its nodes; u32 width of the tree,
//              and 256 more when its nodes are quantised; text how it was made
//
// Payload of a chunk: at most 65,536 rays of one workload, in order. Workloads come one after another.
//              0 32 bytes  name of the workload, padded with zeros
//             32  u32      rays n
//             36  u8       ray kind: 0 closest hit, 1 any hit
//             37  u8       rays: what the ids are: 0 none, 1 pixel (y * width + x), 2 ray of another workload
//                          visits: 1, or 2 with the column of extra hits
//             38  u16      0
//             40  u64      index of the first ray in the workload
//   rays    48 columns of f32[n]: origin x, y, z, t_min, direction x, y, z, t_max; then, with ids, u32[n] ids
//   visits  48 u32 visits m, u32 pair tests p, u32 hits h, u32 0; then columns:
//              u32[n] visits of each ray; u8[n] 1 = has a hit; f32[h] t, u, v and u32[h] primitive of the
//              hits; u32[m] what is visited: a NodeRef as in the memory image (model/memory_image.hpp);
//              u32[m] stack entries dropped after the visit, because they start behind the closest hit;
//              u8[m]  inner node: boxes tested + 16 * children pushed; leaf: pairs tested;
//              u8[p]  triangles tested + 4 * better hits + 16 * those left to the exact pass + 64 * open
//              sides, of each pair test in order; u8[m] extra hits: children entered by their quantised boxes
//              only
//   A column of 4-byte values is stored as 4 planes: the lowest byte of every value, the second byte, ...
//
// Payload of the end block: the header's payload once more; u64 blocks of the file, with the header and this
// one; u32 number of workloads; for each 32 bytes name, u64 ray kind, u64 rays.
//
// A recording that was interrupted has no end block and is called FILE.partial.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "model/regular_file.hpp"
#include "traces/block.hpp"
#include "traces/ray_chunk.hpp"
#include "traces/trace_header.hpp"
#include "traces/visit_chunk.hpp"

namespace rtu::traces {

/// Reads a trace front to back, a chunk at a time: memory does not grow with the trace. Everything that the
/// format fixes is checked. All errors are Error: file, offset of the block, expected, got.
class TraceReader {
  public:
    /// Reads preamble and header.
    explicit TraceReader(const std::filesystem::path& path);

    [[nodiscard]] const TraceHeader& header() const { return header_; }
    /// The next rays; nothing after the last. Throws Error for a trace of visits.
    [[nodiscard]] std::optional<RayChunk> next_rays();
    /// The next visits; nothing after the last. Throws Error for a trace of rays.
    [[nodiscard]] std::optional<VisitChunk> next_visits();
    /// Workloads and rays so far; all of them after the last chunk.
    [[nodiscard]] const std::vector<WorkloadCount>& counts() const { return tally_.counts(); }
    [[nodiscard]] std::uint64_t block_count() const { return block_count_; }
    /// Share of the file that was read.
    [[nodiscard]] double share() const;

  private:
    struct Block {
        BlockFrame frame;
        std::string payload;
    };
    template <class F>
    auto at_block(F f);
    [[nodiscard]] Block read_block();
    [[nodiscard]] std::optional<std::string> next_chunk(TraceContent content);
    void check_end(const std::string& payload);

    std::filesystem::path path_;
    model::RegularFile file_;
    TraceHeader header_;
    WorkloadTally tally_;
    std::uint64_t offset_ = 0;        // of the next byte
    std::uint64_t block_offset_ = 0;  // of the block under way: what errors name
    std::uint64_t block_count_ = 0;
    bool is_at_end_ = false;
};

/// True for a file that begins as traces do; false for any other, and for one that cannot be read.
[[nodiscard]] bool is_trace(const std::filesystem::path& path);

}  // namespace rtu::traces
