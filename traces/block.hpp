#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// The outermost layer of a trace: the preamble, and blocks with checksums. See traces/trace_reader.hpp.

namespace rtu::traces {

inline constexpr std::uint16_t format_version = 1;
inline constexpr std::size_t preamble_bytes = 16;
inline constexpr std::size_t frame_bytes = 40;
/// The first bytes of every frame: where to look for the next block behind a damaged one.
inline constexpr std::string_view frame_magic = "RtBk";
/// A ray chunk has at most 2.4 MB; a ray that visits all nodes of the largest tree has a little less than
/// this.
inline constexpr std::uint32_t most_raw_bytes = 1U << 28;

enum class BlockKind : std::uint8_t { Header = 1, Rays = 2, Visits = 3, End = 4 };

/// What stands before a block's payload.
struct BlockFrame {
    BlockKind kind = BlockKind::Header;
    bool is_compressed = false;
    std::uint32_t stored_bytes = 0;  ///< of the payload in the file
    std::uint32_t raw_bytes = 0;     ///< of the payload after decompression
    std::uint64_t index = 0;         ///< of the block in its file, from 0
    std::uint64_t checksum = 0;      ///< XXH64 of the stored payload
};

/// The 16 bytes at the start of every trace.
[[nodiscard]] std::string preamble();

/// Throws Error unless `bytes` [preamble_bytes] are those of this version: no trace at all, a trace of the
/// other byte order, or of another version.
void check_preamble(std::string_view bytes);

/// Frame and payload of a block, compressed when that makes it smaller.
[[nodiscard]] std::string encode_block(BlockKind kind, std::uint64_t index, std::string_view payload);

/// The frame in `bytes` [frame_bytes]; throws Error when its checksum or a field of it is wrong.
[[nodiscard]] BlockFrame decode_frame(std::string_view bytes);

/// The payload [frame.raw_bytes] of a block, from its stored bytes [frame.stored_bytes]; throws Error when
/// they do not have their checksum.
[[nodiscard]] std::string decode_payload(const BlockFrame& frame, std::string_view stored);

}  // namespace rtu::traces
