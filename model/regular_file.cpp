#include "model/regular_file.hpp"

#include <cerrno>
#include <system_error>

#include "model/error.hpp"
#include "model/one_line.hpp"

namespace rtu::model {

RegularFile::RegularFile(const std::filesystem::path& path) : path_(path) {
    const std::string name = one_line(path.string());
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw Error("{}: no such file", name);
    }
    if (std::filesystem::is_directory(status)) {
        throw Error("{}: expected a file, found a directory", name);
    }
    if (error) {
        throw Error("{}: cannot be read: {}", name, error.message());
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw Error("{}: expected a regular file, found a device, pipe or socket", name);
    }
    size_bytes_ = std::filesystem::file_size(path, error);
    errno = 0;
    stream_.open(path, std::ios::binary);
    if (error || !stream_) {
        throw Error("{}: cannot be read: {}", name,
                    error ? error.message() : std::generic_category().message(errno));
    }
}

void RegularFile::read(void* bytes, std::uint64_t size) {
    if (!stream_.read(static_cast<char*>(bytes), std::streamsize(size))) {
        throw Error("{}: the file ends before its {} bytes could be read", one_line(path_.string()),
                    size_bytes_);
    }
}

}  // namespace rtu::model
