#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace rtu::model {

/// A regular file opened for reading. Throws Error for a missing file, a directory or any other special file,
/// and one that cannot be opened: reading those would block, or never end.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path);
    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }
    /// Reads the next `size` bytes; throws Error when the file ends before.
    void read(void* bytes, std::uint64_t size);
    /// The next read starts at `offset`, counted from the file's start.
    void seek(std::uint64_t offset) { stream_.seekg(std::streamoff(offset)); }

  private:
    std::filesystem::path path_;
    std::ifstream stream_;
    std::uint64_t size_bytes_ = 0;
};

}  // namespace rtu::model
