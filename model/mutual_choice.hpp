#pragma once

#include <cstdint>
#include <span>

#include "model/edge_ring.hpp"
#include "model/matching.hpp"
#include "model/scratch_memory.hpp"

namespace rtu::model {

/// A triangle's sides in the order in which it prefers to be paired across them.
class SideOrder {
  public:
    SideOrder() = default;
    /// From whether side 0 comes before side 1, 1 before 2, and 0 before 2, which must agree with each other.
    SideOrder(bool zero_one, bool one_two, bool zero_two)
        : bits_(std::uint8_t(1U << 2 * (unsigned{zero_one} + unsigned{!one_two}) |
                             2U << 2 * (unsigned{zero_two} + unsigned{one_two}))) {}

    /// The side, 0 to 2, that comes first, second or third: rank 0 to 2.
    [[nodiscard]] std::uint32_t side(std::uint32_t rank) const { return bits_ >> 2 * rank & 3U; }

    /// Whether one of the sides lies on a crowded edge: not before it was set.
    [[nodiscard]] bool is_crowded() const { return (bits_ & crowded) != 0; }
    void set_crowded() { bits_ |= crowded; }

  private:
    static constexpr std::uint8_t crowded = 1U << 6;
    std::uint8_t bits_;
};

/// A greedy matching without sorting. Candidates are neighbours on an edge; each triangle prefers them in the
/// order of its sides, `orders` [T] (their crowded ones are marked here), on one side the lower half-edge
/// first. Each free triangle chooses its first candidate whose other triangle is free; two that choose each
/// other are paired, on all cores, and the others choose again. Where one order of all candidates agrees with
/// the orders of all triangles, a greedy scan in that order accepts the same candidates: each time it accepts
/// one, both triangles have no better one left.
[[nodiscard]] Matching match_by_mutual_choice(std::span<SideOrder> orders, const EdgeRings& rings,
                                              ScratchMemory& memory);

}  // namespace rtu::model
