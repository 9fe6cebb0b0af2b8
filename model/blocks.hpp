#pragma once

#include <algorithm>
#include <cstddef>

#include "model/parallel.hpp"

namespace rtu::model {

/// [0, item_count) cut into blocks of `size` items, the last one shorter. The cut does not depend on the
/// number of threads, and so neither does what is put together block by block.
struct Blocks {
    std::size_t item_count = 0;
    std::size_t size = 1;

    /// Blocks of triangles, vertices or the like: as many as keep the threads evenly at work, but each large
    /// enough to be worth handing out and small enough for the second-level cache.
    [[nodiscard]] static Blocks of_items(std::size_t item_count) {
        return {item_count, std::clamp<std::size_t>(item_count / even_share, 1U << 12, 1U << 14)};
    }
    /// Blocks of groups, each of which alone is worth handing out.
    [[nodiscard]] static Blocks of_groups(std::size_t group_count) {
        return {group_count, std::max<std::size_t>(group_count / even_share, 1)};
    }

    [[nodiscard]] std::size_t count() const { return (item_count + size - 1) / size; }

    /// Calls body(block, begin, end) for every block, on all cores; one block alone stays on this thread.
    template <class Body>
    void for_each(const Body& body) const {
        const auto visit = [&](std::size_t block) {
            body(block, block * size, std::min(item_count, (block + 1) * size));
        };
        if (count() == 1) return visit(0);
        const auto visit_some = [&](const auto& blocks) {
            for (std::size_t block = blocks.begin(); block < blocks.end(); ++block) visit(block);
        };
        // A thread keeps its share from pass to pass, so that it finds it in its own cache.
        for_each_range<std::size_t>(count(), 1, visit_some, tbb::static_partitioner{});
    }

  private:
    static constexpr std::size_t even_share = 32;
};

}  // namespace rtu::model
