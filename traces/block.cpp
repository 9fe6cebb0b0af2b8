#include "traces/block.hpp"

#include <xxhash.h>
#include <zstd.h>

#include "model/error.hpp"
#include "traces/bytes.hpp"

namespace rtu::traces {
namespace {

constexpr std::string_view signature = "\x89RtuTr\r\n";
constexpr std::uint32_t byte_order_mark = 0x01020304;
constexpr std::uint32_t foreign_byte_order_mark = 0x04030201;
// The fastest level that still finds most of what is to be found in byte planes.
constexpr int zstd_level = 3;

// The version is the seed: a block of another version is never taken for one of this.
std::uint64_t checksum_of(std::string_view bytes) {
    return XXH64(bytes.data(), bytes.size(), format_version);
}

void check(std::uint64_t stored, std::uint64_t computed, std::string_view what) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    // A fuzzer cannot guess checksums, and would never get past them.
    static_cast<void>(stored), static_cast<void>(computed), static_cast<void>(what);
#else
    if (stored != computed) {
        throw Error("damaged {}: expected checksum {:016x}, got {:016x}", what, stored, computed);
    }
#endif
}

std::string compressed(std::string_view payload) {
    std::string bytes(ZSTD_compressBound(payload.size()), '\0');
    const std::size_t size =
        ZSTD_compress(bytes.data(), bytes.size(), payload.data(), payload.size(), zstd_level);
    RTU_CHECK(ZSTD_isError(size) == 0, "zstd: {}", ZSTD_getErrorName(size));
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::string preamble() {
    ByteWriter out;
    out.padded(signature, signature.size());
    out.number(byte_order_mark);
    out.number(format_version);
    out.number(std::uint16_t{0});
    return out.bytes();
}

void check_preamble(std::string_view bytes) {
    ByteReader in(bytes);
    if (in.take(signature.size()) != signature) throw Error("not a trace of rtusim: wrong signature");
    const auto mark = in.number<std::uint32_t>();
    if (mark == foreign_byte_order_mark) {
        throw Error("a trace in big-endian byte order, expected little-endian");
    }
    if (mark != byte_order_mark) {
        throw Error("expected byte-order mark {:08x}, got {:08x}", byte_order_mark, mark);
    }
    const auto version = in.number<std::uint16_t>();
    if (version != format_version) {
        throw Error("expected a trace of version {}, got version {}", format_version, version);
    }
    in.zeros(2);
}

std::string encode_block(BlockKind kind, std::uint64_t index, std::string_view payload) {
    RTU_CHECK(payload.size() <= most_raw_bytes, "a block of {} bytes", payload.size());
    const std::string packed = compressed(payload);
    const bool is_compressed = packed.size() < payload.size();
    const std::string_view stored = is_compressed ? std::string_view(packed) : payload;
    ByteWriter out;
    out.padded(frame_magic, frame_magic.size());
    out.number(std::uint8_t(kind));
    out.number(std::uint8_t(is_compressed ? 1 : 0));
    out.number(std::uint16_t{0});
    out.number(std::uint32_t(stored.size()));
    out.number(std::uint32_t(payload.size()));
    out.number(index);
    out.number(checksum_of(stored));
    out.number(checksum_of(out.bytes()));
    return out.bytes().append(stored);
}

BlockFrame decode_frame(std::string_view bytes) {
    ByteReader in(bytes);
    if (in.take(frame_magic.size()) != frame_magic) throw Error("expected a block, found no frame");
    BlockFrame frame;
    const auto kind = in.number<std::uint8_t>();
    const auto codec = in.number<std::uint8_t>();
    in.zeros(2);
    frame.stored_bytes = in.number<std::uint32_t>();
    frame.raw_bytes = in.number<std::uint32_t>();
    frame.index = in.number<std::uint64_t>();
    frame.checksum = in.number<std::uint64_t>();
    check(in.number<std::uint64_t>(), checksum_of(bytes.substr(0, frame_bytes - 8)), "frame of a block");
    if (kind < 1 || kind > 4) throw Error("expected a block of kind 1 to 4, got {}", kind);
    if (codec > 1) throw Error("expected codec 0 (none) or 1 (zstd), got {}", codec);
    frame.kind = BlockKind(kind);
    frame.is_compressed = codec == 1;
    if (frame.raw_bytes > most_raw_bytes || frame.stored_bytes > frame.raw_bytes ||
        (!frame.is_compressed && frame.stored_bytes != frame.raw_bytes)) {
        throw Error("expected a block of at most {} bytes, stored in no more, got {} stored in {}",
                    most_raw_bytes, frame.raw_bytes, frame.stored_bytes);
    }
    return frame;
}

std::string decode_payload(const BlockFrame& frame, std::string_view stored) {
    check(frame.checksum, checksum_of(stored), "block");
    if (!frame.is_compressed) return std::string(stored);
    const unsigned long long size = ZSTD_getFrameContentSize(stored.data(), stored.size());
    if (size != frame.raw_bytes) throw Error("expected a zstd frame of {} bytes", frame.raw_bytes);
    std::string payload(frame.raw_bytes, '\0');
    const std::size_t got = ZSTD_decompress(payload.data(), payload.size(), stored.data(), stored.size());
    if (ZSTD_isError(got) != 0) throw Error("zstd: {}", ZSTD_getErrorName(got));
    if (got != payload.size()) throw Error("expected {} bytes from zstd, got {}", payload.size(), got);
    return payload;
}

}  // namespace rtu::traces
