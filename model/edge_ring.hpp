#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/half_edge.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// The half-edges of every edge, in file order, as a ring.
class EdgeRings {
  public:
    EdgeRings(const IdentifiedMesh& mesh, ScratchMemory& memory);

    /// The next one on the same edge, the first after the last; the half-edge itself when it is alone.
    [[nodiscard]] HalfEdge next(HalfEdge h) const { return next_[h.index]; }
    /// Whether there are more than two on the edge.
    [[nodiscard]] bool is_crowded(HalfEdge h) const { return next(next(h)) != h; }
    /// The one before on a crowded edge; nothing before its first one.
    [[nodiscard]] std::optional<HalfEdge> previous(HalfEdge h) const;

    /// Calls visit(half_edge) for every one on a crowded edge, some of them twice.
    template <class Visit>
    void for_each_crowded(Visit visit) const {
        for (const auto& [half_edge, previous] : previous_) {
            visit(half_edge);
            visit(previous);
        }
    }

  private:
    struct Link {
        HalfEdge half_edge, previous;
    };

    /// Puts a half-edge behind `last`, so far the last of the edge that begins with `head`; all three the
    /// same begin a ring.
    void append(HalfEdge head, HalfEdge last, HalfEdge half_edge, std::vector<Link>& previous) {
        if (head != last) {
            if (next(head) == last) previous.push_back({last, head});
            previous.push_back({half_edge, last});
        }
        next_[last.index] = half_edge;
        next_[half_edge.index] = head;
    }

    std::span<HalfEdge> next_;    // [3 T]
    std::vector<Link> previous_;  // on crowded edges, ordered by half-edge
};

/// A side of each of two triangles that lies on an edge common to both: the lowest such side of
/// `first`, and there the lowest of `second`; an empty answer if they have none or are the same.
[[nodiscard]] std::optional<std::pair<HalfEdge, HalfEdge>> common_edge(const IdentifiedMesh& mesh,
                                                                       std::uint32_t first,
                                                                       std::uint32_t second);

}  // namespace rtu::model
