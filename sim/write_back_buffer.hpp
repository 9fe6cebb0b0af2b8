#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/cache_tags.hpp"

namespace rtu::sim {

/// Replaced lines with dirty sectors, on their way below in the order in which they were replaced.
class WriteBackBuffer {
  public:
    /// Enough to decouple a replacement from the channel below; assumed.
    static constexpr std::size_t entry_count = 8;
    /// Adjacent dirty sectors of one line: what one write below carries.
    struct Run {
        std::uint32_t line_number = 0;
        std::uint32_t first_sector = 0;
        std::uint32_t sector_count = 0;
    };

    WriteBackBuffer() { entries_.reserve(entry_count); }
    [[nodiscard]] bool is_full() const { return entries_.size() == entry_count; }
    [[nodiscard]] bool is_empty() const { return entries_.empty(); }
    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    [[nodiscard]] bool holds(std::uint32_t line_number) const {
        return std::ranges::any_of(entries_, [&](const Entry& e) { return e.line_number == line_number; });
    }
    void push(std::uint32_t line_number, SectorMask dirty) { entries_.push_back({line_number, dirty}); }
    /// Takes the next run out. The buffer must not be empty.
    Run pop_run() {
        Entry& oldest = entries_.front();
        const auto first = std::uint32_t(std::countr_zero(oldest.dirty));
        const auto count = std::uint32_t(std::countr_one(oldest.dirty >> first));
        const Run run{oldest.line_number, first, count};
        for (std::uint32_t i = first; i < first + count; ++i) oldest.dirty &= ~(SectorMask(1) << i);
        if (oldest.dirty == 0) entries_.erase(entries_.begin());
        return run;
    }

  private:
    struct Entry {
        std::uint32_t line_number = 0;
        SectorMask dirty = 0;
    };
    std::vector<Entry> entries_;
};

}  // namespace rtu::sim
