#include "traces/partial_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "model/error.hpp"

namespace rtu::traces {
namespace {

namespace fs = std::filesystem;

std::string message(int error_number) { return std::generic_category().message(error_number); }

// The file that a path stands for: a link keeps being a link when its target is replaced.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
    return target.empty() ? path : target;
}

// Pipes and devices cannot be replaced by renaming; /dev/stdout and the like must not be, even where they
// lead to a file. Other files below /dev, as in /dev/shm, are files like any.
bool is_special(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) return false;
    const std::string name = path.lexically_normal().string();
    return !fs::is_regular_file(path, error) || name.starts_with("/dev/std") || name.starts_with("/dev/fd/");
}

}  // namespace

PartialFile::PartialFile(const fs::path& path, OnFullDisk on_full_disk, std::string_view suffix)
    : path_(path), on_full_disk_(on_full_disk) {
    std::error_code error;
    if (!path.has_filename()) throw Error("'{}': cannot write: not the name of a file", path.string());
    if (fs::is_directory(path, error)) throw Error("{}: cannot write: {}", path.string(), message(EISDIR));
    if (is_special(path)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        target_ = resolved(path);
        partial_ = fs::path(target_).concat(suffix);
        descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (descriptor_ >= 0) return;
    if (errno != EEXIST) throw Error("{}: cannot write: {}", path.string(), message(errno));
    throw Error(
        "{}: is there already: another process writes it, or was interrupted (save its content with `rtusim "
        "trace verify --recover`, or remove it)",
        partial_.string());
}

PartialFile::~PartialFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (!partial_.empty()) ::unlink(partial_.c_str());
}

void PartialFile::fail(std::uint64_t offset) {
    const std::string why = message(errno);
    const bool is_kept = on_full_disk_ == OnFullDisk::Keep && !partial_.empty();
    if (is_kept) {
        ::close(descriptor_);
        descriptor_ = -1;  // and so it stays
    }
    throw Error("{}: byte {}: cannot write: {}{}", path_.string(), offset, why,
                is_kept
                    ? fmt::format("; {} holds what was written before (see `rtusim trace verify --recover`)",
                                  partial_.filename().string())
                    : "");
}

void PartialFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(size_bytes_);
        size_bytes_ += std::uint64_t(count);
        bytes.remove_prefix(std::size_t(count));
    }
}

void PartialFile::rewrite(std::uint64_t offset, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), off_t(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(offset);
        offset += std::uint64_t(count);
        bytes.remove_prefix(std::size_t(count));
    }
}

void PartialFile::commit() {
    const int result = ::close(descriptor_);  // network file systems report a full disk only here
    descriptor_ = -1;
    if (result == 0 && partial_.empty()) return;
    if (result == 0 && ::rename(partial_.c_str(), target_.c_str()) == 0) return;
    throw Error("{}: cannot write: {}", path_.string(), message(errno));
}

}  // namespace rtu::traces
