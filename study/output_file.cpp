#include "study/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <vector>

#include "model/error.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;

using PathList = std::vector<std::string>;

// The temporary files of the write under way; the signal handler reads it, so it is published only when
// complete.
std::atomic<const PathList*> temporaries{nullptr};
static_assert(std::atomic<const PathList*>::is_always_lock_free, "the signal handler must not lock");

void remove_temporaries() {
    const PathList* list = temporaries.exchange(nullptr);
    if (list == nullptr) return;
    for (const std::string& path : *list) ::unlink(path.c_str());
}

extern "C" void on_signal(int signal) {
    remove_temporaries();
    ::_exit(128 + signal);
}

[[noreturn]] void fail(const fs::path& path, int error_number) {
    throw Error("{}: cannot write: {}", path.string(), std::generic_category().message(error_number));
}

// A file descriptor that is closed whatever happens.
class Descriptor {
  public:
    // `named` is what error messages call the file: a temporary file speaks for its target.
    Descriptor(const fs::path& path, int flags, const fs::path& named)
        : named_(named), value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        if (value_ < 0) fail(named_, errno);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t count = ::write(value_, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(named_, errno);
            bytes.remove_prefix(std::size_t(count));
        }
    }
    // Network file systems report a full disk only here.
    void close() {
        const int result = ::close(value_);
        value_ = -1;
        if (result < 0) fail(named_, errno);
    }

  private:
    fs::path named_;
    int value_;
};

// The file that a path stands for, absolute: a link keeps being a link when its target is replaced.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
    return target.empty() ? path : target;
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path temporary_name(const fs::path& path) {
    return folder_of(path) / fmt::format(".{}.{}.tmp", path.filename().string(), ::getpid());
}

// Pipes and devices cannot be replaced by renaming; /dev/stdout and /dev/fd/3, links, must not be, even where
// they lead to a file. A file of its own in /dev/shm is like any other.
bool is_special(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) return false;
    const bool is_stream =
        fs::is_symlink(path, error) && path.lexically_normal().string().starts_with("/dev/");
    return is_stream || !fs::is_regular_file(path, error);
}

// The only reliable answer to "can a file be made here" is to make one.
void probe(const fs::path& folder, const fs::path& named) {
    const fs::path path = temporary_name(folder / "rtusim-probe");
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) fail(named, errno);
    ::close(descriptor);
    ::unlink(path.c_str());
}

void write_whole(const OutputFile& file, const fs::path& to, int flags) {
    Descriptor descriptor(to, O_WRONLY | flags, file.path);
    descriptor.write(file.bytes);
    descriptor.close();
}

// One output and the name under which it is staged; devices and pipes have none.
struct Staged {
    const OutputFile* file;
    std::string temporary;
};

void commit(std::span<const Staged> outputs) {
    for (const auto& [file, temporary] : outputs) {
        if (temporary.empty()) continue;
        ::unlink(temporary.c_str());  // of a killed process that had the same id
        write_whole(*file, temporary, O_CREAT | O_EXCL);
    }
    // What cannot be taken back comes after all that can fail without a trace, and before the first file
    // appears.
    for (const auto& [file, temporary] : outputs) {
        if (temporary.empty()) write_whole(*file, file->path, 0);
    }
    for (const auto& [file, temporary] : outputs) {
        if (temporary.empty()) continue;
        if (::rename(temporary.c_str(), resolved(file->path).c_str()) != 0) fail(file->path, errno);
    }
}

}  // namespace

void check_writable(const fs::path& path) {
    std::error_code error;
    if (!path.has_filename()) throw Error("'{}': cannot write: not the name of a file", path.string());
    if (fs::is_directory(path, error)) fail(path, EISDIR);
    if (fs::exists(path, error) && ::access(path.c_str(), W_OK) != 0) fail(path, errno);
    if (is_special(path)) return;
    const fs::path folder = folder_of(resolved(path));
    if (!fs::is_directory(folder, error))
        throw Error("{}: cannot write: no folder {}", path.string(), folder.string());
    probe(folder, path);
}

void check_writable_folder(const fs::path& folder) {
    std::error_code error;
    fs::path existing = resolved(folder);
    while (!fs::exists(existing, error) && existing.has_relative_path()) existing = existing.parent_path();
    if (!fs::is_directory(existing, error))
        throw Error("{}: expected a folder, {} is a file", folder.string(), existing.string());
    probe(existing, folder);
}

void write_files(std::span<const OutputFile> files) {
    std::vector<Staged> outputs;
    PathList names;
    for (const OutputFile& file : files) {
        std::error_code error;
        fs::create_directories(folder_of(resolved(file.path)), error);
        if (error) fail(file.path, error.value());
        outputs.push_back({&file, is_special(file.path) ? "" : temporary_name(resolved(file.path)).string()});
        if (!outputs.back().temporary.empty()) names.push_back(outputs.back().temporary);
    }
    temporaries = &names;
    try {
        commit(outputs);
    } catch (...) {
        remove_temporaries();
        throw;
    }
    temporaries = nullptr;
}

void remove_temporaries_on_interrupt() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        const auto previous = std::signal(signal, on_signal);
        if (signal == SIGHUP && previous == SIG_IGN) std::signal(signal, SIG_IGN);  // nohup asked for it
    }
}

}  // namespace rtu::study
