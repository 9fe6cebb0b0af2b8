#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/mailbox.hpp"
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
    std::uint64_t mailbox_hits = 0;  ///< leaves that were passed over
    std::uint64_t duplicate_tests =
        0;  ///< of the pair tests, those of a pair that its ray had been tested with
    TraversalCounts& operator+=(const TraversalCounts& other) {
        node_visits += other.node_visits;
        box_tests += other.box_tests;
        pair_tests += other.pair_tests;
        triangle_tests += other.triangle_tests;
        mailbox_hits += other.mailbox_hits;
        duplicate_tests += other.duplicate_tests;
        return *this;
    }
    friend bool operator==(const TraversalCounts&, const TraversalCounts&) = default;
};

/// A child that waits to be visited, and where the ray enters its box.
struct StackEntry {
    NodeRef ref;
    float t_near = 0;
};

/// A traversal stack that is made large enough once, so that nothing is checked in the hot loop.
class TraversalStack {
  public:
    /// Forgets all entries and makes room for `capacity`.
    void reset(std::size_t capacity) {
        size_ = 0;
        if (entries_.size() < capacity) entries_.resize(capacity);
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Requires size() < capacity.
    void push(StackEntry entry) { entries_[size_++] = entry; }
    /// Requires size() > 0.
    StackEntry pop() { return entries_[--size_]; }
    [[nodiscard]] StackEntry& operator[](std::size_t index) { return entries_[index]; }

  private:
    std::vector<StackEntry> entries_;
    std::size_t size_ = 0;
};

/// The nearest hit so far.
struct Closest {
    Hit hit;  ///< hit.t = t_max until something is hit
    bool is_found = false;
};

/// One ray under way, for a machine that takes it step by step.
struct Traversal {
    RaySetup ray;
    RayKind kind = RayKind::ClosestHit;
    Closest closest;
    StackEntry current;
    TraversalStack stack;
};

/// Entries that a traversal of this image can ever stack: (width - 1) a level.
[[nodiscard]] std::size_t stack_capacity(const MemoryImage& image);

/// Puts `traversal` at the root for a new ray; its stack keeps its memory and has room for the whole walk.
/// False: the ray cannot hit anything (a component is not finite, the direction is zero, or the interval is
/// empty) and must not be traversed.
[[nodiscard]] bool start(Traversal& traversal, const MemoryImage& image, const Ray& ray, RayKind kind);

/// Boxes that a visit of inner node `ref` tests: its children, 1 to width.
[[nodiscard]] std::uint32_t child_count(const MemoryImage& image, NodeRef ref);

/// Tests all children of `current` (an inner node) and pushes those that the ray enters, far ones first;
/// among equal distances the lower child index is visited first. Returns the number of boxes tested.
std::uint32_t visit_node(Traversal& traversal, const MemoryImage& image);

/// What one pair test took.
struct PairVisit {
    std::uint32_t triangle_tests = 0;
    std::uint32_t exact_tests = 0;  ///< of those, what the first pass let through: see test_pair()
    std::uint32_t better_hits = 0;  ///< of those, what became the closest hit, each in its turn
    std::uint32_t side_tests = 0;   ///< of the exact tests, those whose sides the first pass left open
};

/// Tests pair `index` of `current` (a leaf) and keeps the nearer hit; of equal t the lowest primitive id
/// wins.
PairVisit visit_pair(Traversal& traversal, const MemoryImage& image, std::uint32_t index);

/// The same for any pair, without a tree; `closest` begins as {Hit{.t = ray.t_max}}.
PairVisit visit_pair(Closest& closest, const LeafPair& pair, const RaySetup& ray);

/// Pops entries until one can still matter (it starts no farther than the closest hit) and makes it
/// `current`; entries at or below `floor` stay. False when none is left above `floor`.
[[nodiscard]] bool pop(Traversal& traversal, std::size_t floor = 0);

/// True when an any-hit ray has its answer.
[[nodiscard]] inline bool is_satisfied(const Traversal& t) {
    return t.kind == RayKind::AnyHit && t.closest.is_found;
}

/// The reference traversal: the hit of one ray, or nothing. Adds what it did to `counts` when given.
[[nodiscard]] std::optional<Hit> trace(const MemoryImage& image, const Ray& ray, RayKind kind,
                                       TraversalCounts* counts = nullptr);

/// The same, reusing a stack: for many rays on one thread.
[[nodiscard]] std::optional<Hit> trace(TraversalStack& stack, const MemoryImage& image, const Ray& ray,
                                       RayKind kind, TraversalCounts* counts = nullptr);

/// The same with a mailbox, which is cleared first; a mailbox that is off counts the duplicate tests. The hit
/// is the same, to the bit.
[[nodiscard]] std::optional<Hit> trace(TraversalStack& stack, Mailbox& mailbox, const MemoryImage& image,
                                       const Ray& ray, RayKind kind, TraversalCounts* counts = nullptr);

}  // namespace rtu::model
