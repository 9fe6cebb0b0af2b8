#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rtu::traces {

/// A file that is written piece by piece under the name FILE.partial, and gets its own name when it is
/// complete.
///
/// A process that is killed, or a disk that is full, leaves FILE.partial, of which a trace can be recovered;
/// any other end before commit() removes it. What an earlier one left is never overwritten. Devices and pipes
/// (/dev/stdout, say) are written directly. Every function throws Error naming the file and the offset.
class PartialFile {
  public:
    /// What becomes of FILE.partial when a write fails.
    enum class OnFullDisk : std::uint8_t { Keep, Remove };

    /// `suffix` is for who reads FILE.partial while writing FILE.
    PartialFile(const std::filesystem::path& path, OnFullDisk on_full_disk,
                std::string_view suffix = ".partial");
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;
    ~PartialFile();

    void write(std::string_view bytes);
    /// Replaces bytes that were written before, for a header that needs a count; not on a pipe.
    void rewrite(std::uint64_t offset, std::string_view bytes);
    /// The file is complete: it gets its name, and replaces what had it.
    void commit();
    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }

  private:
    [[noreturn]] void fail(std::uint64_t offset);

    std::filesystem::path path_;     ///< as it was named
    std::filesystem::path partial_;  ///< empty: written directly
    std::filesystem::path target_;
    OnFullDisk on_full_disk_;
    int descriptor_ = -1;
    std::uint64_t size_bytes_ = 0;
};

}  // namespace rtu::traces
