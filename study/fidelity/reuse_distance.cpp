#include "study/fidelity/reuse_distance.hpp"

#include <algorithm>
#include <bit>

#include "model/memory_image.hpp"

namespace rtu::study {
namespace {

constexpr std::size_t first_capacity = 1 << 20;  // 4 MiB: seldom full

}  // namespace

ReuseDistances::ReuseDistances(std::uint32_t line_bytes, std::uint64_t memory_bytes)
    : blocks_per_line_shift_(std::uint32_t(std::countr_zero(std::max(line_bytes, model::image_block_bytes)) -
                                           std::countr_zero(model::image_block_bytes))),
      last_of_block_(memory_bytes / model::image_block_bytes + 1, 0),
      last_of_line_((last_of_block_.size() >> blocks_per_line_shift_) + 1, 0),
      tree_(first_capacity + 1, 0) {}

std::uint64_t ReuseDistances::access(std::uint64_t address, std::uint32_t size_bytes) {
    std::uint64_t farthest = 0;
    const std::uint64_t last = (address + size_bytes - 1) / model::image_block_bytes;
    for (std::uint64_t block = address / model::image_block_bytes; block <= last; ++block) {
        farthest = std::max(farthest, access_block(block));
    }
    return farthest;
}

std::uint64_t ReuseDistances::access_block(std::uint64_t block) {
    if (now_ + 1 == tree_.size()) make_room();
    std::uint32_t& of_block = last_of_block_[block];
    std::uint32_t& of_line = last_of_line_[block >> blocks_per_line_shift_];
    // The block's own line does not count, and it was touched at that time or later.
    const std::uint64_t distance = of_block == 0 ? never : count_since(of_block) - 1;
    ++now_;
    if (of_line == 0) {
        ++lines_;
    } else {
        add(of_line, -1);
    }
    add(now_, 1);
    of_line = of_block = now_;
    return distance;
}

void ReuseDistances::add(std::uint32_t time, std::int32_t value) {
    for (; time < tree_.size(); time += time & (~time + 1)) tree_[time] += value;
}

// Lines whose last access was at `time` or later.
std::uint64_t ReuseDistances::count_since(std::uint32_t time) const {
    std::int64_t before = 0;
    for (std::uint32_t i = time - 1; i > 0; i -= i & (~i + 1)) before += tree_[i];
    return lines_ - std::uint64_t(before);
}

// Times grow without end: renumbers those that still matter, and grows when most do.
void ReuseDistances::make_room() {
    std::vector<std::uint32_t> renumbered(now_ + 1, 0);
    for (const auto* times : {&last_of_block_, &last_of_line_})
        for (const std::uint32_t time : *times) renumbered[time] = 1;
    std::uint32_t next = 0;
    renumbered[0] = 0;
    for (std::uint32_t time = 1; time <= now_; ++time)
        if (renumbered[time] != 0) renumbered[time] = ++next;
    for (auto* times : {&last_of_block_, &last_of_line_})
        for (std::uint32_t& time : *times) time = renumbered[time];
    now_ = next;
    tree_.assign(std::max<std::size_t>(tree_.size(), 2 * std::size_t(next) + first_capacity), 0);
    for (const std::uint32_t time : last_of_line_)
        if (time != 0) add(time, 1);
}

}  // namespace rtu::study
