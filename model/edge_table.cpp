#include "model/edge_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "model/distribute.hpp"

namespace rtu::model {

namespace {

/// Visits the half-edges of one triangle with their groups, in a form that distribute takes.
template <class Visit>
void visit_half_edges(const Triangle& corners, std::uint32_t triangle, std::uint32_t vertex_bits,
                      const Visit& visit) {
    const auto& [a, b, c] = corners;
    const std::uint32_t first = 3 * triangle;
    if (a != b && b != c && c != a) {
        const std::uint32_t ab = std::min(a, b), bc = std::min(b, c), ca = std::min(c, a);
        return visit(
            std::array{ab >> vertex_bits, bc >> vertex_bits, ca >> vertex_bits},
            std::array{EdgeRecord{ab, std::max(a, b), {first}}, EdgeRecord{bc, std::max(b, c), {first + 1}},
                       EdgeRecord{ca, std::max(c, a), {first + 2}}});
    }
    for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t p = corners[side], q = corners[(side + 1) % 3], lower = std::min(p, q);
        if (p != q) visit(lower >> vertex_bits, EdgeRecord{lower, std::max(p, q), {first + side}});
    }
}

}  // namespace

EdgeGroups group_half_edges(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    // Up to some 25,000 half-edges a group, but no more groups than have their write streams in the cache.
    constexpr std::uint32_t least_vertex_bits = 12, most_group_bits = 11;
    const auto id_bits = std::uint32_t(std::bit_width(mesh.positions.size()));
    const std::uint32_t vertex_bits =
        std::max(least_vertex_bits, id_bits - std::min(id_bits, most_group_bits));
    const auto group_count = std::uint32_t((mesh.positions.size() >> vertex_bits) + 1);
    const auto records = memory.take<EdgeRecord>(3 * mesh.triangles.size());
    const auto generate = [&](std::size_t begin, std::size_t end, const auto& visit) {
        const IdentifiedMesh local = mesh;  // for all that the compiler knows the writes could change `mesh`
        const std::uint32_t shift = vertex_bits;
        for (auto triangle = std::uint32_t(begin); triangle < end; ++triangle) {
            visit_half_edges(local.corners(triangle), triangle, shift, visit);
        }
    };
    auto begins = distribute(Blocks::of_items(mesh.triangles.size()), group_count, records, generate);
    return {records.first(begins.back()), std::move(begins), vertex_bits};
}

void sort_bucket(std::span<BucketedHalfEdge> bucket) {
    if (bucket.size() > small_bucket) {
        std::sort(bucket.begin(), bucket.end());
        return;
    }
    // Insertion without an early exit: each step compiles to a minimum and a maximum. Nothing is
    // mispredicted, which makes it twice as fast as std::sort on the usual two to twelve entries.
    for (std::size_t i = 1; i < bucket.size(); ++i) {
        for (std::size_t j = i; j > 0; --j) {
            const BucketedHalfEdge left = bucket[j - 1], right = bucket[j];
            bucket[j - 1] = lesser(left, right);
            bucket[j] = greater(left, right);
        }
    }
}

void EdgeGroupSorter::fill_buckets(std::size_t group) {
    const std::uint32_t begin = groups_.begins[group], size = groups_.begins[group + 1] - begin;
    const auto records = groups_.records.subspan(begin, size);
    const std::uint32_t mask = (1U << groups_.vertex_bits) - 1;
    auto& place = bucket_ends_;  // counts, then where the next goes
    place.assign(std::size_t{mask} + 1, 0U);
    for (const EdgeRecord& record : records) ++place[record.lower_vertex & mask];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), 0U);
    if (entries_.size() < size) entries_.resize(size);
    for (const EdgeRecord& record : records) {
        entries_[place[record.lower_vertex & mask]++] = {record.upper_vertex, record.half_edge};
    }
}

}  // namespace rtu::model
