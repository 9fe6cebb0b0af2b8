#pragma once

// Half-edges grouped into edges. Sorting all of them by (lower vertex, upper vertex, half-edge) is a
// distribution into groups of consecutive lower vertices, each small enough for the second-level cache, there
// a counting sort by the lower vertex and then a sort of each vertex's few half-edges.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/half_edge.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// A half-edge and the ends of its edge.
struct EdgeRecord {
    std::uint32_t lower_vertex, upper_vertex;
    HalfEdge half_edge;
};

/// Half-edges in groups by lower vertex, in each group ascending.
struct EdgeGroups {
    std::span<EdgeRecord> records;
    std::vector<std::uint32_t> begins;  ///< [count() + 1] where each group begins in `records`
    std::uint32_t vertex_bits = 0;      ///< group g has the lower vertices [g << bits, (g + 1) << bits)

    [[nodiscard]] std::size_t count() const { return begins.size() - 1; }
};

/// Half-edges whose two ends are the same vertex are left out: they are no edges.
[[nodiscard]] EdgeGroups group_half_edges(const IdentifiedMesh& mesh, ScratchMemory& memory);

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

/// In buckets of up to so many entries, comparing all with all is the fastest.
inline constexpr std::size_t small_bucket = 16;

/// Sorts one bucket.
void sort_bucket(std::span<BucketedHalfEdge> bucket);

/// Sorts groups one after the other, in memory of its own.
class EdgeGroupSorter {
  public:
    explicit EdgeGroupSorter(const EdgeGroups& groups) : groups_(groups) {}

    /// Calls `visit(lower_vertex, upper_vertex, first, second)` for every two neighbours in the sorted
    /// half-edge table that lie on the same edge of this group, in the table's order: an edge of n half-edges
    /// gives n - 1 calls. `first` < `second`; both can belong to one triangle (a, b, a). The group's records
    /// are not read after the first call.
    template <class Visit>
    void for_each_twin(std::size_t group, Visit visit) {
        fill_buckets(group);
        const std::span<BucketedHalfEdge> entries = entries_;
        std::uint32_t begin = 0, lower = std::uint32_t(group << groups_.vertex_bits);
        for (const std::uint32_t end : bucket_ends_) {
            const std::span bucket = entries.subspan(begin, end - begin);
            sort_bucket(bucket);
            for (std::size_t i = 1; i < bucket.size(); ++i) {
                if (bucket[i - 1].upper_vertex() != bucket[i].upper_vertex()) continue;
                visit(lower, bucket[i].upper_vertex(), bucket[i - 1].half_edge(), bucket[i].half_edge());
            }
            begin = end;
            ++lower;
        }
    }

    /// Calls `visit(head, last, half_edge)` for every half-edge of this group, with the first one of its edge
    /// and the one before it, or with itself twice if it is the first. Those of one edge come in ascending
    /// order; edges mix.
    template <class Visit>
    void for_each_half_edge(std::size_t group, Visit visit) {
        fill_buckets(group);
        const std::span<BucketedHalfEdge> entries = entries_;
        std::uint32_t begin = 0;
        for (const std::uint32_t end : bucket_ends_) {
            const std::span bucket = entries.subspan(begin, end - begin);
            if (bucket.size() <= small_bucket) {
                visit_small(bucket, visit);
            } else {
                visit_large(bucket, visit);
            }
            begin = end;
        }
    }

  private:
    void fill_buckets(std::size_t group);

    template <class Visit>
    static void visit_small(std::span<const BucketedHalfEdge> bucket, Visit visit) {
        std::array<std::uint32_t, small_bucket> heads;
        for (std::uint32_t i = 0; i < bucket.size(); ++i) {
            // Comparing with all before takes no branch that could be mispredicted, and no sort.
            std::uint32_t last = i;
            for (std::uint32_t k = 0; k < i; ++k) {
                last = bucket[k].upper_vertex() == bucket[i].upper_vertex() ? k : last;
            }
            heads[i] = i;
            heads[i] = heads[last];
            visit(bucket[heads[i]].half_edge(), bucket[last].half_edge(), bucket[i].half_edge());
        }
    }

    template <class Visit>
    static void visit_large(std::span<BucketedHalfEdge> bucket, Visit visit) {
        sort_bucket(bucket);
        std::size_t head = 0;
        for (std::size_t i = 0; i < bucket.size(); ++i) {
            if (bucket[head].upper_vertex() != bucket[i].upper_vertex()) head = i;
            visit(bucket[head].half_edge(), bucket[head == i ? i : i - 1].half_edge(), bucket[i].half_edge());
        }
    }

    const EdgeGroups& groups_;
    std::vector<std::uint32_t> bucket_ends_;  // a bucket begins where the one before it ends
    std::vector<BucketedHalfEdge> entries_;   // those of the group first; never shrinks
};

/// EdgeGroupSorter::for_each_twin for every group in turn, on this thread.
template <class Visit>
void for_each_twin(const IdentifiedMesh& mesh, ScratchMemory& memory, Visit visit) {
    const ScratchMemory::Scope scope(memory);
    const EdgeGroups groups = group_half_edges(mesh, memory);
    EdgeGroupSorter sorter(groups);
    for (std::size_t group = 0; group < groups.count(); ++group) sorter.for_each_twin(group, visit);
}

}  // namespace rtu::model
