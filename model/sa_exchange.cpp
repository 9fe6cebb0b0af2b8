#include "model/sa_exchange.hpp"

#include <optional>

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
    Exchange(const IdentifiedMesh& mesh, const EdgeRings& rings, Matching& matching)
        : mesh_(mesh), rings_(rings), matching_(matching) {}

    /// Pairs a free triangle with the neighbour that it pays most to take away from its partner, if any.
    void try_take(std::uint32_t free) {
        const Aabb box = triangle_box(mesh_, free);
        std::optional<Take> best;
        for (std::uint32_t side = 3 * free; side < 3 * free + 3; ++side) {
            const std::uint32_t neighbour = rings_.next({side}).triangle();
            if (neighbour == free || matching_.is_free(neighbour)) continue;
            const Take take = consider({side}, box);
            if (take.gain > (best ? best->gain : 0)) best = take;
        }
        if (!best) return;
        matching_.unpair(best->taken.triangle());
        matching_.try_pair(best->own, best->taken);
        if (best->offer) matching_.try_pair(best->offer->own, best->offer->other);
    }

  private:
    struct Offer {
        HalfEdge own, other;
        double weight;
    };

    struct Take {
        HalfEdge own, taken;
        double gain = 0;  ///< NaN where an area overflowed
        std::optional<Offer> offer;
    };

    /// What taking the neighbour on side `own` changes; `own_box` is that of the side's triangle.
    [[nodiscard]] Take consider(HalfEdge own, const Aabb& own_box) const {
        Take take{own, rings_.next(own), 0, std::nullopt};
        const std::uint32_t taken = take.taken.triangle(), left = matching_.partner(taken).triangle();
        const Aabb taken_box = triangle_box(mesh_, taken), left_box = triangle_box(mesh_, left);
        take.gain = weight(own_box, taken_box) - weight(taken_box, left_box);
        // A pair saves no more than the area of either: most end here.
        if (!(take.gain + double(left_box.half_area()) > 0)) return take;
        take.offer = best_offer(left, left_box, own.triangle());
        if (take.offer) take.gain += take.offer->weight;
        return take;
    }

    [[nodiscard]] static double weight(const Aabb& a, const Aabb& b) {
        const PairAreas areas = pair_areas(a, b);
        return areas.saving() - growth_cost * areas.growth();
    }

    /// The best pair that pays of `triangle` with a free neighbour other than `except`.
    [[nodiscard]] std::optional<Offer> best_offer(std::uint32_t triangle, const Aabb& box,
                                                  std::uint32_t except) const {
        std::optional<Offer> best;
        for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
            const HalfEdge own{side}, other = rings_.next({side});
            const std::uint32_t neighbour = other.triangle();
            if (neighbour == triangle || neighbour == except || !matching_.is_free(neighbour)) continue;
            const double value = weight(box, triangle_box(mesh_, neighbour));
            if (value > (best ? best->weight : 0)) best = {own, other, value};
        }
        return best;
    }

    const IdentifiedMesh& mesh_;
    const EdgeRings& rings_;
    Matching& matching_;
};

}  // namespace

Matching match_with_exchanges(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const EdgeRings rings(mesh, memory);
    Matching matching = match_by_edge_area(mesh, rings, memory);
    Exchange exchange(mesh, rings, matching);
    for (std::uint32_t t = 0; t < matching.triangle_count(); ++t) {
        if (matching.is_free(t)) exchange.try_take(t);
    }
    return matching;
}

}  // namespace rtu::model
