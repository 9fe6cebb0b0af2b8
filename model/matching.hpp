#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "model/half_edge.hpp"
#include "model/scratch_memory.hpp"

namespace rtu::model {

/// Which triangles are paired with which, and on which of their sides. Lives no longer than its memory.
class Matching {
  public:
    /// All triangles free.
    Matching(std::uint32_t triangle_count, ScratchMemory& memory)
        : is_paired_(memory.take<std::uint8_t>(triangle_count)),
          partner_(memory.take<HalfEdge>(triangle_count)) {
        std::ranges::fill(is_paired_, std::uint8_t{0});
        for (std::uint32_t t = 0; t < triangle_count; ++t) partner_[t] = {3 * t};
    }
    /// `is_paired` (0 or 1) and `partner`, [triangle_count] both, as is_free and partner give them.
    Matching(std::span<std::uint8_t> is_paired, std::span<HalfEdge> partner, std::uint32_t pair_count)
        : is_paired_(is_paired), partner_(partner), pair_count_(pair_count) {}

    [[nodiscard]] std::uint32_t triangle_count() const { return std::uint32_t(partner_.size()); }
    [[nodiscard]] std::uint32_t pair_count() const { return pair_count_; }
    [[nodiscard]] bool is_free(std::uint32_t triangle) const { return is_paired_[triangle] == 0; }
    /// The side on which a paired triangle's partner meets it; a free triangle is its own partner.
    [[nodiscard]] HalfEdge partner(std::uint32_t triangle) const { return partner_[triangle]; }
    /// Pairs two triangles on these sides if they are different and both free; returns whether it did.
    bool try_pair(HalfEdge a, HalfEdge b) {
        const std::uint32_t t = a.triangle(), u = b.triangle();
        // One branch on three conditions: each alone is hard to predict.
        if (int(t == u) | is_paired_[t] | is_paired_[u]) return false;
        is_paired_[t] = is_paired_[u] = 1;
        partner_[t] = b;
        partner_[u] = a;
        ++pair_count_;
        return true;
    }

    /// Frees a paired triangle and its partner.
    void unpair(std::uint32_t triangle) {
        const std::uint32_t other = partner_[triangle].triangle();
        is_paired_[triangle] = is_paired_[other] = 0;
        partner_[triangle] = {3 * triangle};
        partner_[other] = {3 * other};
        --pair_count_;
    }

  private:
    std::span<std::uint8_t> is_paired_;
    std::span<HalfEdge> partner_;
    std::uint32_t pair_count_ = 0;
};

}  // namespace rtu::model
