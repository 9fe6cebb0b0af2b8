#include "model/gltf_buffers.hpp"

#include <tiny_gltf.h>

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/regular_file.hpp"

namespace rtu::model {

namespace {

namespace fs = std::filesystem;

/// Replaces %XX by the byte it stands for; anything else stays.
std::string decode_percent(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        if (uri[i] == '%' && i + 2 < uri.size()) {
            const char* digits = uri.data() + i + 1;
            if (std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
                path += static_cast<char>(byte);
                i += 2;
                continue;
            }
        }
        path += uri[i];
    }
    return path;
}

bool is_inside(const fs::path& path, const fs::path& folder) {
    const fs::path relative = path.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

/// The file that `uri` names, symbolic links resolved.
fs::path confined_path(std::string_view uri, const fs::path& gltf_file, const std::string& where) {
    const fs::path relative = decode_percent(uri);
    const fs::path folder = fs::canonical(gltf_file.has_parent_path() ? gltf_file.parent_path() : ".");
    std::error_code error;
    fs::path path = fs::weakly_canonical(folder / relative, error);
    if (uri.find("://") != std::string_view::npos || relative.is_absolute() || error ||
        !is_inside(path, folder)) {
        throw Error("{}: expected a file in the folder of the glTF file, found '{}'", where, one_line(uri));
    }
    return path;
}

BufferBytes read_external(std::string_view uri, std::uint64_t size, const fs::path& gltf_file,
                          const std::string& where) {
    const fs::path path = confined_path(uri, gltf_file, where);
    try {
        RegularFile file(path);
        if (file.size_bytes() < size) {
            throw Error("{}: expected {} bytes, found {}", one_line(path.string()), size, file.size_bytes());
        }
        BufferBytes bytes(size);
        file.read(bytes.data(), size);
        return bytes;
    } catch (const Error& error) {
        throw Error("{}: {}", where, error.what());
    }
}

BufferBytes decode_data_uri(const std::string& uri, const std::string& where) {
    BufferBytes bytes;
    std::string mime_type;
    if (!tinygltf::IsDataURI(uri) || !tinygltf::DecodeDataURI(&bytes, mime_type, uri, 0, false)) {
        throw Error(
            "{}: expected a base64 data URI of type application/octet-stream or application/gltf-buffer, "
            "found '{}'",
            where, one_line(std::string_view(uri).substr(0, 60)));
    }
    return bytes;
}

/// Cuts padding off; what is missing is an error.
BufferBytes cut_to_size(BufferBytes bytes, std::uint64_t size, const std::string& where) {
    if (bytes.size() < size) {
        throw Error("{}: expected {} bytes, found {}", where, size, bytes.size());
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::vector<BufferBytes> load_gltf_buffers(const nlohmann::json& document, BufferBytes binary_chunk,
                                           const fs::path& file) {
    std::vector<BufferBytes> buffers;
    if (!document.contains("buffers")) {
        return buffers;
    }
    for (const nlohmann::json& buffer : document["buffers"]) {
        const std::string where = fmt::format("{}: buffers[{}]", one_line(file.string()), buffers.size());
        const auto size = buffer["byteLength"].get<std::uint64_t>();
        if (size == 0) {
            throw Error("{}.byteLength: expected at least 1, found 0", where);
        }
        if (!buffer.contains("uri")) {
            if (!buffers.empty() || binary_chunk.empty()) {
                throw Error("{}: expected a uri{}, found none", where,
                            buffers.empty() ? " or a GLB binary chunk" : "");
            }
            buffers.push_back(
                cut_to_size(std::exchange(binary_chunk, {}), size, where + " (the GLB binary chunk)"));
            continue;
        }
        const auto& uri = buffer["uri"].get_ref<const std::string&>();
        buffers.push_back(uri.starts_with("data:") ? cut_to_size(decode_data_uri(uri, where), size, where)
                                                   : read_external(uri, size, file, where));
    }
    return buffers;
}

}  // namespace rtu::model
