#include "study/sweep/sweep_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "model/error.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;

constexpr auto patience = std::chrono::seconds(3);

// The lock goes with the folder: a process that waited for one that was removed meanwhile must ask again.
bool is_same_file(int descriptor, const fs::path& path) {
    struct stat held {
    }, there{};
    return ::fstat(descriptor, &held) == 0 && ::stat(path.c_str(), &there) == 0 &&
           held.st_ino == there.st_ino && held.st_dev == there.st_dev;
}

}  // namespace

SweepFolder::SweepFolder(const fs::path& database) : path_(fs::absolute(database).concat(".work")) {
    const auto end = std::chrono::steady_clock::now() + patience;
    const fs::path lock = path_ / "lock";
    while (true) {
        std::error_code error;
        fs::create_directories(path_, error);
        if (error) throw Error("{}: cannot make the folder: {}", path_.string(), error.message());
        // Not closed on exec: the children hold it too, so that none is left when another process gets it.
        lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT, 0666);
        if (lock_ < 0 && errno != ENOENT)
            throw Error("{}: cannot write: {}", lock.string(), std::generic_category().message(errno));
        if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0 && is_same_file(lock_, lock)) return;
        if (lock_ >= 0) ::close(lock_);
        lock_ = -1;
        if (std::chrono::steady_clock::now() > end)
            throw Error("{}: another sweep works there", path_.string());
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

SweepFolder::~SweepFolder() {
    if (lock_ >= 0) ::close(lock_);
}

void SweepFolder::remove_journals() const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(path_, error)) {
        if (entry.path().extension() == ".journal") fs::remove(entry.path(), error);
    }
}

void SweepFolder::remove() const {
    std::error_code error;
    fs::remove_all(path_, error);
}

}  // namespace rtu::study
