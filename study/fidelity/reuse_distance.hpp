#pragma once

#include <cstdint>
#include <vector>

namespace rtu::study {

/// LRU stack distances of a stream of memory accesses [MGST70]: how many distinct cache lines were touched
/// since a block's last access. A fully associative LRU cache of n lines that fetches single blocks finds a
/// block exactly when its distance is less than n.
class ReuseDistances {
  public:
    /// `line_bytes`: a power of two; a block is 64 bytes, and a line is one at least. Accesses lie below
    /// `memory_bytes`.
    ReuseDistances(std::uint32_t line_bytes, std::uint64_t memory_bytes);

    static constexpr std::uint64_t never = ~std::uint64_t{0};
    /// Takes the access; returns the largest distance of its blocks, or `never` when one is new.
    std::uint64_t access(std::uint64_t address, std::uint32_t size_bytes);

  private:
    [[nodiscard]] std::uint64_t access_block(std::uint64_t block);
    void add(std::uint32_t time, std::int32_t value);
    [[nodiscard]] std::uint64_t count_since(std::uint32_t time) const;
    void make_room();

    std::uint32_t blocks_per_line_shift_;
    std::vector<std::uint32_t> last_of_block_;  // time of a block's last access, from 1; 0: never
    std::vector<std::uint32_t> last_of_line_;
    std::vector<std::int32_t> tree_;  // Fenwick tree over times: 1 where a line was accessed last
    std::uint64_t lines_ = 0;         // accessed so far
    std::uint32_t now_ = 0;
};

}  // namespace rtu::study
