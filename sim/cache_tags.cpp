#include "sim/cache_tags.hpp"

#include <bit>
#include <limits>

#include "model/error.hpp"

namespace rtu::sim {
namespace {

// The tag of an entry that holds nothing; the cache refuses addresses that would reach it.
constexpr std::uint32_t no_line = std::numeric_limits<std::uint32_t>::max();

}  // namespace

CacheTags::CacheTags(const Config::Cache& config) : ways_(config.ways) {
    const std::uint32_t sets = config.size_bytes / config.line_bytes / config.ways;
    RTU_CHECK(std::has_single_bit(sets), "{} cache sets are not a power of two", sets);
    set_mask_ = sets - 1;
    const std::size_t entries = std::size_t(sets) * ways_;
    tags_.assign(entries, no_line);
    last_use_.assign(entries, 0);
    lines_.resize(entries);
    const std::size_t places = std::bit_ceil(4 * entries);
    likely_entries_.assign(places, 0);
    likely_mask_ = std::uint32_t(places - 1);
}

std::optional<std::uint32_t> CacheTags::search(std::uint32_t line_number) const {
    const std::uint32_t first = first_entry(line_number);
    for (std::uint32_t entry = first; entry < first + ways_; ++entry) {
        if (tags_[entry] == line_number) return entry;
    }
    return std::nullopt;
}

std::optional<std::uint32_t> CacheTags::victim(std::uint32_t line_number) const {
    const std::uint32_t first = first_entry(line_number);
    std::optional<std::uint32_t> oldest;
    for (std::uint32_t entry = first; entry < first + ways_; ++entry) {
        if (lines_[entry].pending != 0) continue;
        if (!oldest || last_use_[entry] < last_use_[*oldest]) oldest = entry;
    }
    return oldest;
}

void CacheTags::replace(std::uint32_t entry, std::uint32_t line_number) {
    tags_[entry] = line_number;
    lines_[entry] = {};
    likely_entries_[line_number & likely_mask_] = entry;
}

}  // namespace rtu::sim
