#include "model/gltf_container.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"

namespace rtu::model {

namespace {

constexpr std::uint32_t json_chunk = 0x4e4f'534a;
constexpr std::uint32_t binary_chunk = 0x004e'4942;
constexpr std::uint64_t header_bytes = 12;
constexpr std::uint64_t chunk_header_bytes = 8;
// The JSON library's interface counts in 32 bits.
constexpr std::uint64_t max_json_bytes = std::numeric_limits<std::int32_t>::max();

std::uint32_t read_uint32(RegularFile& file) {
    std::array<unsigned char, 4> b{};
    file.read(b.data(), b.size());
    return std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 |
           std::uint32_t(b[3]) << 24;
}

/// `start`, which has been read already, and the bytes that follow it up to `size`.
std::string read_text(RegularFile& file, std::string start, std::uint64_t size, const std::string& name) {
    if (size > max_json_bytes) {
        throw Error("{}: expected at most {} bytes of JSON, found {}", name, max_json_bytes, size);
    }
    const std::size_t start_bytes = start.size();
    start.resize(size);
    file.read(start.data() + start_bytes, size - start_bytes);
    return start;
}

/// Reads the chunks that follow the magic.
GltfContainer read_glb(RegularFile& file, const std::string& name) {
    if (file.size_bytes() < header_bytes + chunk_header_bytes) {
        throw Error("{}: truncated: a GLB has at least {} bytes, found {}", name,
                    header_bytes + chunk_header_bytes, file.size_bytes());
    }
    if (const std::uint32_t version = read_uint32(file); version != 2) {
        throw Error("{}: expected glTF version 2, found version {}", name, version);
    }
    const std::uint64_t length = read_uint32(file);
    if (length > file.size_bytes()) {
        throw Error("{}: truncated: the GLB header says {} bytes, the file has {}", name, length,
                    file.size_bytes());
    }
    std::uint64_t position = header_bytes;
    const auto enter_chunk = [&] {
        const std::uint64_t chunk_bytes = read_uint32(file);
        position += chunk_header_bytes;
        if (position + chunk_bytes > length) {
            throw Error("{}: the chunk at byte {} has {} bytes, but the GLB ends at byte {}", name,
                        position - chunk_header_bytes, chunk_bytes, length);
        }
        return chunk_bytes;
    };
    GltfContainer container;
    const std::uint64_t json_bytes = enter_chunk();
    if (const std::uint32_t type = read_uint32(file); type != json_chunk) {
        throw Error("{}: expected the first GLB chunk to be JSON, found type {:#010x}", name, type);
    }
    container.json = read_text(file, "", json_bytes, name);
    position += json_bytes;
    if (position + chunk_header_bytes <= length) {
        const std::uint64_t chunk_bytes = enter_chunk();
        if (read_uint32(file) == binary_chunk) {
            container.binary_chunk.resize(chunk_bytes);
            file.read(container.binary_chunk.data(), chunk_bytes);
        }
    }
    return container;
}

/// Whether the text can be a JSON object: tells text from other binary formats with a better message than a
/// parser.
bool looks_like_json(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) {
        text.remove_prefix(3);
    }
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}

}  // namespace

GltfContainer read_gltf_container(const std::filesystem::path& path) {
    const std::string name = one_line(path.string());
    RegularFile file(path);
    if (file.size_bytes() == 0) {
        throw Error("{}: the file is empty", name);
    }
    const std::uint64_t magic_bytes = std::min<std::uint64_t>(4, file.size_bytes());
    std::string magic = read_text(file, "", magic_bytes, name);
    if (magic == "glTF") {
        return read_glb(file, name);
    }
    std::string text = read_text(file, std::move(magic), file.size_bytes(), name);
    if (!looks_like_json(text)) {
        throw Error("{}: not a glTF file: expected a JSON object or a GLB header", name);
    }
    return {std::move(text), {}};
}

}  // namespace rtu::model
