#include "model/mutual_choice.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "model/blocks.hpp"

namespace rtu::model {
namespace {

class MutualChoice {
  public:
    MutualChoice(std::span<const SideOrder> orders, const EdgeRings& rings, ScratchMemory& memory)
        : orders_(orders),
          rings_(rings),
          is_paired_(memory.take<std::uint8_t>(orders.size())),
          choice_(memory.take<HalfEdge>(orders.size())),
          open_(memory.take<std::uint32_t>(orders.size())),
          blocks_(Blocks::of_items(orders.size())),
          open_counts_(blocks_.count()) {
        blocks_.for_each([this](std::size_t block, std::size_t begin, std::size_t end) {
            std::ranges::fill(is_paired_.subspan(begin, end - begin), std::uint8_t{0});
            const auto open = open_.subspan(begin, end - begin);
            std::iota(open.begin(), open.end(), std::uint32_t(begin));
            open_counts_[block] = end - begin;
        });
    }

    Matching match() {
        std::size_t open = orders_.size();
        while (open > 0) {
            const std::size_t before = std::exchange(open, pair_mutual_choices());
            // Handing out a few takes longer than to pair them, and in a strip whose edges grow all along
            // each round would pair but its last two triangles.
            constexpr std::size_t few = 1024;
            if (open < few || open > before / 8 * 7) {
                follow_choices();
                break;
            }
        }
        return {is_paired_, choice_, count_pairs()};
    }

  private:
    [[nodiscard]] bool can_pair(std::uint32_t t, HalfEdge other) const {
        return other.triangle() != t && is_paired_[other.triangle()] == 0;
    }

    /// The other half-edge of the first candidate of `t` that can be paired; 3 t if there is none.
    [[nodiscard]] HalfEdge choose(std::uint32_t t) const {
        if (orders_[t].is_crowded()) return choose_crowded(t);
        HalfEdge choice{3 * t};
        // From the last to the first without a branch: which of them are free is hard to predict.
        for (const std::uint32_t rank : {2U, 1U, 0U}) {
            const HalfEdge other = rings_.next({3 * t + orders_[t].side(rank)});
            choice = can_pair(t, other) ? other : choice;
        }
        return choice;
    }

    [[nodiscard]] HalfEdge choose_crowded(std::uint32_t t) const {
        for (const std::uint32_t rank : {0U, 1U, 2U}) {
            const HalfEdge own{3 * t + orders_[t].side(rank)}, next = rings_.next(own);
            const bool is_crowded = rings_.is_crowded(own);
            if (const auto previous = rings_.previous(own); previous && can_pair(t, *previous))
                return *previous;
            // The last one's next is the first of its edge: on a crowded one that is no neighbour.
            if ((next > own || !is_crowded) && can_pair(t, next)) return next;
        }
        return {3 * t};
    }

    /// Every open triangle chooses; returns how many are then still open.
    std::size_t pair_mutual_choices() {
        blocks_.for_each([this](std::size_t block, std::size_t begin, std::size_t) {
            for (const std::uint32_t t : open_.subspan(begin, open_counts_[block])) choice_[t] = choose(t);
        });
        blocks_.for_each([this](std::size_t block, std::size_t begin, std::size_t) {
            std::size_t next = begin;
            for (const std::uint32_t t : open_.subspan(begin, open_counts_[block])) {
                const std::uint32_t other = choice_[t].triangle();
                const bool is_mutual = choice_[other].triangle() == t, has_choice = other != t;
                is_paired_[t] = std::uint8_t(is_mutual & has_choice);
                open_[next] = t;
                next += std::size_t{!is_mutual};
            }
            open_counts_[block] = next - begin;
        });
        return std::accumulate(open_counts_.begin(), open_counts_.end(), std::size_t{0});
    }

    /// Pairs all open triangles, one after the other. Along a chain of choices the candidates get better, so
    /// it ends with two that choose each other.
    void follow_choices() {
        std::vector<std::uint32_t> chain;
        for (std::size_t block = 0; block < open_counts_.size(); ++block) {
            for (const std::uint32_t t : open_.subspan(block * blocks_.size, open_counts_[block])) {
                chain = {t};
                while (!chain.empty()) extend_or_end(chain);
            }
        }
    }

    void extend_or_end(std::vector<std::uint32_t>& chain) {
        const std::uint32_t t = chain.back();
        if (is_paired_[t] != 0) return chain.pop_back();
        choice_[t] = choose(t);
        const std::uint32_t other = choice_[t].triangle();
        if (other == t) return chain.pop_back();
        choice_[other] = choose(other);
        if (choice_[other].triangle() != t) return chain.push_back(other);
        is_paired_[t] = is_paired_[other] = 1;
    }

    [[nodiscard]] std::uint32_t count_pairs() const {
        std::vector<std::uint32_t> counts(blocks_.count());
        blocks_.for_each([&](std::size_t block, std::size_t begin, std::size_t end) {
            const auto is_paired = is_paired_.subspan(begin, end - begin);
            counts[block] = std::accumulate(is_paired.begin(), is_paired.end(), 0U);
        });
        return std::accumulate(counts.begin(), counts.end(), 0U) / 2;
    }

    std::span<const SideOrder> orders_;
    const EdgeRings& rings_;
    std::span<std::uint8_t> is_paired_;
    std::span<HalfEdge> choice_;     // across which side of its partner, once it is paired
    std::span<std::uint32_t> open_;  // in each block's part, its triangles that are still to be decided
    Blocks blocks_;
    std::vector<std::size_t> open_counts_;  // [blocks_.count()]
};

}  // namespace

Matching match_by_mutual_choice(std::span<SideOrder> orders, const EdgeRings& rings, ScratchMemory& memory) {
    rings.for_each_crowded([&](HalfEdge h) { orders[h.triangle()].set_crowded(); });
    return MutualChoice(orders, rings, memory).match();
}

}  // namespace rtu::model
