#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/ray_setup.hpp"

namespace rtu::model {

/// What a traversal did; definitions in docs/report.md.
struct TraversalCounts {
    std::uint64_t node_visits = 0;
    std::uint64_t box_tests = 0;
    std::uint64_t pair_tests = 0;
    std::uint64_t triangle_tests = 0;
    friend bool operator==(const TraversalCounts&, const TraversalCounts&) = default;
};

/// A child that waits to be visited, and where the ray enters its box.
struct StackEntry {
    NodeRef ref;
    float t_near = 0;
};

/// One ray under way. The stack's capacity must be at least `stack_capacity(image)`.
struct Traversal {
    RaySetup ray;
    RayKind kind = RayKind::ClosestHit;
    Hit best;  ///< best.t = t_max until something is hit
    bool has_hit = false;
    StackEntry current;
    std::vector<StackEntry> stack;
};

/// Entries that a traversal of this image can ever stack: (width - 1) a level.
[[nodiscard]] std::size_t stack_capacity(const MemoryImage& image);

/// Puts `traversal` at the root for a new ray; its stack keeps its memory. False: the ray cannot hit anything (a
/// component is not finite, the direction is zero, or the interval is empty) and must not be traversed.
[[nodiscard]] bool start(Traversal& traversal, const MemoryImage& image, const Ray& ray, RayKind kind);

/// Tests all children of `current` (an inner node) and pushes those that the ray enters, far ones first; among equal
/// distances the lower child index is visited first. Returns the number of boxes tested.
std::uint32_t visit_node(Traversal& traversal, const MemoryImage& image);

/// What one pair test found: how many of the pair's triangles the ray's line pierces (0, 1; 2 for a folded pair).
struct PairVisit {
    std::uint32_t triangle_tests = 0;
    std::uint32_t pierced = 0;
};

/// Tests pair `index` of `current` (a leaf) and keeps the nearer hit; of equal t the lowest primitive id wins.
PairVisit visit_pair(Traversal& traversal, const MemoryImage& image, std::uint32_t index);

/// Pops entries until one can still matter (it starts no farther than the best hit) and makes it `current`; entries
/// at or below `floor` stay. False when none is left above `floor`.
[[nodiscard]] bool pop(Traversal& traversal, std::size_t floor = 0);

/// True when an any-hit ray has its answer.
[[nodiscard]] inline bool is_satisfied(const Traversal& t) { return t.kind == RayKind::AnyHit && t.has_hit; }

/// The reference traversal: the hit of one ray, or nothing. Adds what it did to `counts` when given.
[[nodiscard]] std::optional<Hit> trace(const MemoryImage& image, const Ray& ray, RayKind kind,
                                       TraversalCounts* counts = nullptr);

/// The same, reusing `scratch` for the stack: for many rays on one thread.
[[nodiscard]] std::optional<Hit> trace(Traversal& scratch, const MemoryImage& image, const Ray& ray, RayKind kind,
                                       TraversalCounts* counts = nullptr);

}  // namespace rtu::model
