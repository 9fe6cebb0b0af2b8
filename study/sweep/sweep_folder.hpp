#pragma once

#include <filesystem>

namespace rtu::study {

/// The folder beside a database in which a sweep works, held by one process at a time: by this one and its
/// children, until all have ended.
class SweepFolder {
  public:
    /// Makes DATABASE.work; waits some seconds for the workers of a process that was killed to end. Throws
    /// Error when another sweep works there.
    explicit SweepFolder(const std::filesystem::path& database);
    SweepFolder(const SweepFolder&) = delete;
    SweepFolder& operator=(const SweepFolder&) = delete;
    ~SweepFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Removes the journals.
    void remove_journals() const;
    /// Removes the folder with everything in it.
    void remove() const;

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace rtu::study
