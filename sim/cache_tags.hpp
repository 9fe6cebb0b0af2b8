#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/config.hpp"

namespace rtu::sim {

/// A set of sectors of one line; bit i is sector i.
using SectorMask = std::uint32_t;
inline constexpr std::uint32_t max_sectors_per_line = 32;

/// A cache's tags: set associative, least recently used first out, with the state of every line's sectors.
/// Lines are named by their number (address / line size), entries by their place (set, way).
class CacheTags {
  public:
    struct Line {
        SectorMask valid = 0;
        SectorMask dirty = 0;  ///< part of `valid`
        SectorMask pending =
            0;  ///< requested from below; while any is, the line holds `mshr` and cannot leave
        std::uint32_t mshr = 0;
    };

    /// The number of sets (size / line / ways) must be a power of two.
    explicit CacheTags(const Config::Cache& config);

    /// The entry that holds the line; empty when none does.
    [[nodiscard]] std::optional<std::uint32_t> find(std::uint32_t line_number) const {
        // Where a line with these low bits was last put: right for nearly every line that is there, and a
        // quarter of the time of an access cheaper than comparing all ways.
        const std::uint32_t likely = likely_entries_[line_number & likely_mask_];
        if (tags_[likely] == line_number) return likely;
        return search(line_number);
    }
    /// Makes the entry the most recently used one of its set.
    void touch(std::uint32_t entry) { last_use_[entry] = ++clock_; }
    /// The least recently used entry that may take the line; empty while every way has a fill on its way.
    [[nodiscard]] std::optional<std::uint32_t> victim(std::uint32_t line_number) const;
    /// Gives the entry to another line, without any valid sector yet.
    void replace(std::uint32_t entry, std::uint32_t line_number);

    [[nodiscard]] std::uint32_t line_number(std::uint32_t entry) const { return tags_[entry]; }
    [[nodiscard]] Line& operator[](std::uint32_t entry) { return lines_[entry]; }

  private:
    [[nodiscard]] std::optional<std::uint32_t> search(std::uint32_t line_number) const;
    [[nodiscard]] std::uint32_t first_entry(std::uint32_t line_number) const {
        return (line_number & set_mask_) * ways_;
    }

    std::uint32_t ways_;
    std::uint32_t set_mask_;
    // [entry]; separate arrays, so that a search touches one host cache line for 16 ways.
    std::vector<std::uint32_t> tags_;
    std::vector<std::uint64_t> last_use_;
    std::vector<Line> lines_;
    std::vector<std::uint32_t> likely_entries_;  // [low bits of a line number]: only ever a guess
    std::uint32_t likely_mask_;
    std::uint64_t clock_ = 0;
};

}  // namespace rtu::sim
