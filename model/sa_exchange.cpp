#include "model/sa_exchange.hpp"

#include <optional>
#include <span>

#include "model/edge_bbsa.hpp"
#include "model/edge_ring.hpp"
#include "model/pair_saving.hpp"

namespace rtu::model {
namespace {

/// What the growth of a leaf's box costs in box tests further up, per unit of its cost in pair tests.
/// Measured: 1/2 and 1 do no harm on any scene; 0 and 2 do on one (docs/pairing.md).
constexpr double growth_cost = 0.5;

class Exchange {
  public:
    Exchange(const IdentifiedMesh& mesh, std::span<const HalfEdge> ring, Matching& matching)
        : mesh_(mesh), ring_(ring), matching_(matching) {}

    /// Pairs the triangle of `free` with that of `taken`, whose partner loses it, if that pays.
    void try_take(HalfEdge free, HalfEdge taken) {
        const HalfEdge left = matching_.partner(taken.triangle());
        const double gain = weight(free, taken) - weight(matching_.partner(left.triangle()), left);
        const std::optional<Offer> offer = best_offer(left.triangle(), free.triangle());
        if (!(gain + (offer ? offer->weight : 0) > 0)) return;  // NaN: an area that overflowed
        matching_.unpair(left.triangle());
        matching_.try_pair(free, taken);
        if (offer) matching_.try_pair(offer->own, offer->other);
    }

  private:
    struct Offer {
        HalfEdge own, other;
        double weight;
    };

    [[nodiscard]] double weight(HalfEdge a, HalfEdge b) const {
        const PairAreas areas = pair_areas(mesh_, a, b);
        return areas.saving() - growth_cost * areas.growth();
    }

    /// The best pair that pays of `triangle` with a free neighbour other than `except`.
    [[nodiscard]] std::optional<Offer> best_offer(std::uint32_t triangle, std::uint32_t except) const {
        std::optional<Offer> best;
        for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
            const HalfEdge own{side}, other = ring_[side];
            const std::uint32_t neighbour = other.triangle();
            if (neighbour == triangle || neighbour == except || !matching_.is_free(neighbour)) continue;
            const double value = weight(own, other);
            if (value > (best ? best->weight : 0)) best = {own, other, value};
        }
        return best;
    }

    const IdentifiedMesh& mesh_;
    std::span<const HalfEdge> ring_;
    Matching& matching_;
};

}  // namespace

Matching match_with_exchanges(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto candidates = edge_bbsa_candidates(mesh, memory);
    Matching matching = match_greedily(candidates, std::uint32_t(mesh.triangles.size()), memory);
    const auto ring = edge_rings(mesh, candidates, memory);
    Exchange exchange(mesh, ring, matching);
    for (const auto& [rank, first, second] : candidates) {
        const bool is_first_free = matching.is_free(first.triangle());
        if (is_first_free == matching.is_free(second.triangle())) continue;
        if (is_first_free) {
            exchange.try_take(first, second);
        } else {
            exchange.try_take(second, first);
        }
    }
    return matching;
}

}  // namespace rtu::model
