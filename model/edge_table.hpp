#pragma once

// Half-edges grouped into edges. Sorting all of them by (lower vertex, upper vertex, half-edge) is a counting
// sort by the lower vertex and then a sort of each vertex's few half-edges, which lie in one or two cache
// lines.

#include <algorithm>
#include <cstdint>
#include <span>

#include "model/half_edge.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// A half-edge in the bucket of its lower vertex; ordered by (upper vertex, half-edge).
class BucketedHalfEdge {
  public:
    BucketedHalfEdge() = default;
    BucketedHalfEdge(std::uint32_t upper_vertex, HalfEdge half_edge)
        : bits_(std::uint64_t(upper_vertex) << 32 | half_edge.index) {}
    [[nodiscard]] std::uint32_t upper_vertex() const { return std::uint32_t(bits_ >> 32); }
    [[nodiscard]] HalfEdge half_edge() const { return {std::uint32_t(bits_)}; }
    friend bool operator<(BucketedHalfEdge a, BucketedHalfEdge b) { return a.bits_ < b.bits_; }
    /// Of two entries the one that comes first and last; without a branch.
    friend BucketedHalfEdge lesser(BucketedHalfEdge a, BucketedHalfEdge b) {
        return BucketedHalfEdge(a.bits_ < b.bits_ ? a.bits_ : b.bits_);
    }
    friend BucketedHalfEdge greater(BucketedHalfEdge a, BucketedHalfEdge b) {
        return BucketedHalfEdge(a.bits_ < b.bits_ ? b.bits_ : a.bits_);
    }

  private:
    explicit BucketedHalfEdge(std::uint64_t bits) : bits_(bits) {}
    std::uint64_t bits_;
};

/// Half-edges in buckets by lower vertex, not yet sorted within a bucket.
struct EdgeBuckets {
    std::span<std::uint32_t> ends;  ///< [vertex_count] a bucket begins where the one before it ends
    std::span<BucketedHalfEdge> entries;
};

/// Half-edges whose two ends are the same vertex are left out: they are no edges.
[[nodiscard]] EdgeBuckets bucket_half_edges(const IdentifiedMesh& mesh, ScratchMemory& memory);

/// Sorts one bucket.
void sort_bucket(std::span<BucketedHalfEdge> bucket);

/// Calls `visit(lower_vertex, upper_vertex, first, second)` for every two neighbours in the sorted half-edge
/// table that lie on the same edge, in the table's order: an edge of n half-edges gives n - 1 calls. `first`
/// < `second`; both can belong to one triangle (a, b, a).
template <class Visit>
void for_each_twin(const IdentifiedMesh& mesh, ScratchMemory& memory, Visit visit) {
    const ScratchMemory::Scope scope(memory);
    const EdgeBuckets buckets = bucket_half_edges(mesh, memory);
    std::uint32_t begin = 0;
    for (std::uint32_t lower = 0; lower < buckets.ends.size(); ++lower) {
        const std::uint32_t end = buckets.ends[lower];
        const std::span bucket = buckets.entries.subspan(begin, end - begin);
        sort_bucket(bucket);
        for (std::size_t i = 1; i < bucket.size(); ++i) {
            if (bucket[i - 1].upper_vertex() != bucket[i].upper_vertex()) continue;
            visit(lower, bucket[i].upper_vertex(), bucket[i - 1].half_edge(), bucket[i].half_edge());
        }
        begin = end;
    }
}

}  // namespace rtu::model
