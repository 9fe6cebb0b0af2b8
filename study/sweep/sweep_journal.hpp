#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Where a process that simulates points leaves what they gave, so that nothing is lost whoever is killed
// when. A journal is a text file that one process writes, a line a point: 16 hex digits, the fingerprint of
// the rest; a space; the rest. A point is complete when its line is, line feed included.

namespace rtu::study {

/// Writes one journal.
class JournalWriter {
  public:
    /// Makes the file; throws Error when it cannot, or it is there already.
    explicit JournalWriter(const std::filesystem::path& path);
    JournalWriter(const JournalWriter&) = delete;
    JournalWriter& operator=(const JournalWriter&) = delete;
    ~JournalWriter();

    /// Appends a line in one piece; `text` has no line feed. Throws Error when it cannot, and then the
    /// journal ends in a part of the line, that nobody reads: it must not be written on.
    void add(std::string_view text);

  private:
    std::filesystem::path path_;
    int descriptor_;
};

/// The whole lines of a journal behind `offset`, and where they end.
struct JournalPart {
    std::vector<std::string> lines;
    std::uint64_t end = 0;
};

/// Reads on from `offset`. Stops before the first line that is damaged or not whole.
[[nodiscard]] JournalPart read_journal(const std::filesystem::path& path, std::uint64_t offset);

}  // namespace rtu::study
