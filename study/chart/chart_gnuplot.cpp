#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "study/chart/chart_format.hpp"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace rtu::study {
namespace {

constexpr const char* missing = "charts need gnuplot: install it (on Debian: apt-get install gnuplot-nox)";

// A file in memory: unlike a pipe it takes any amount without a reader.
class MemoryFile {
  public:
    explicit MemoryFile(const char* name) : descriptor_(::memfd_create(name, MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw Error("gnuplot: {}", std::generic_category().message(errno));
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(descriptor_); }
    [[nodiscard]] int descriptor() const { return descriptor_; }

    // Writes all of it and goes back to the beginning.
    void fill(std::string_view text) {
        while (!text.empty()) {
            const ssize_t count = ::write(descriptor_, text.data(), text.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) throw Error("gnuplot: {}", std::generic_category().message(errno));
            text.remove_prefix(std::size_t(count));
        }
        ::lseek(descriptor_, 0, SEEK_SET);
    }
    [[nodiscard]] std::string content() const {
        std::string text;
        std::array<char, 65536> buffer{};
        for (off_t offset = 0;;) {
            const ssize_t count = ::pread(descriptor_, buffer.data(), buffer.size(), offset);
            if (count <= 0) return text;
            text.append(buffer.data(), std::size_t(count));
            offset += count;
        }
    }

  private:
    int descriptor_;
};

struct SpawnActions {
    SpawnActions() { posix_spawn_file_actions_init(&actions); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions); }
    posix_spawn_file_actions_t actions{};
};

// Runs gnuplot without its user's settings (-d); returns its exit status.
int run_gnuplot(const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
    SpawnActions redirect;
    posix_spawn_file_actions_adddup2(&redirect.actions, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&redirect.actions, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&redirect.actions, err.descriptor(), STDERR_FILENO);
    std::string program = "gnuplot", no_settings = "-d";
    std::array<char*, 3> arguments{program.data(), no_settings.data(), nullptr};
    pid_t child = 0;
    const int error =
        ::posix_spawnp(&child, "gnuplot", &redirect.actions, nullptr, arguments.data(), environ);
    if (error == ENOENT) throw Error("{}", missing);
    if (error != 0) throw Error("gnuplot: {}", std::generic_category().message(error));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw Error("gnuplot: {}", std::generic_category().message(errno));
    }
    return status;
}

}  // namespace

void check_gnuplot() {
    const char* path = std::getenv("PATH");
    std::string_view folders = path != nullptr ? path : "/usr/bin:/bin";
    while (!folders.empty()) {
        const std::size_t end = std::min(folders.find(':'), folders.size());
        const std::filesystem::path folder(folders.substr(0, end));
        if (::access((folder / "gnuplot").c_str(), X_OK) == 0) return;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    throw Error("{}", missing);
}

std::string run_gnuplot_script(std::string_view script, std::string_view name) {
    MemoryFile in("chart-script");
    const MemoryFile out("chart"), err("chart-errors");
    in.fill(script);
    const int status = run_gnuplot(in, out, err);
    std::string bytes = out.content();
    if (status != 0 || bytes.empty()) {
        throw Error("gnuplot could not draw {}: {}", name, model::one_line(err.content()));
    }
    return bytes;
}

}  // namespace rtu::study
