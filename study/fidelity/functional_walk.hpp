#pragma once

#include <cstdint>

#include "model/traversal.hpp"
#include "model/traversal_log.hpp"

namespace rtu::study {

/// What rays take of the machine, whatever its timing.
struct RayWork {
    double rays = 0;
    double node_visits = 0;
    double box_tests = 0;
    double leaf_visits = 0;
    double pair_tests = 0;
    double triangle_tests = 0;
    double survivor_pairs = 0;  ///< with a triangle that the first pass of the pair test lets through
    double survivors = 0;       ///< such triangles
    double better_hits = 0;     ///< of them, the ones that became the best hit
    double side_tests = 0;      ///< of them, the ones whose sides the first pass left open

    RayWork& operator+=(const RayWork& other) {
        rays += other.rays;
        node_visits += other.node_visits;
        box_tests += other.box_tests;
        leaf_visits += other.leaf_visits;
        pair_tests += other.pair_tests;
        triangle_tests += other.triangle_tests;
        survivor_pairs += other.survivor_pairs;
        survivors += other.survivors;
        better_hits += other.better_hits;
        side_tests += other.side_tests;
        return *this;
    }
    friend RayWork operator*(double factor, const RayWork& work) {
        return {factor * work.rays,           factor * work.node_visits, factor * work.box_tests,
                factor * work.leaf_visits,    factor * work.pair_tests,  factor * work.triangle_tests,
                factor * work.survivor_pairs, factor * work.survivors,   factor * work.better_hits,
                factor * work.side_tests};
    }
};

/// What a logged ray took.
[[nodiscard]] inline RayWork work_of(const model::TraversalLog& log) {
    return {1,
            double(log.node_visits),
            double(log.box_tests),
            double(log.leaf_visits),
            double(log.pair_tests),
            double(log.pairs.triangle_tests),
            double(log.survivor_pairs),
            double(log.pairs.exact_tests),
            double(log.pairs.better_hits),
            double(log.pairs.side_tests)};
}

/// Bytes that a visit of the node or leaf reads.
[[nodiscard]] inline std::uint32_t fetched_bytes(const model::MemoryImage& image, model::NodeRef ref) {
    return ref.is_leaf() ? ref.pair_count() * model::image_block_bytes : std::uint32_t(image.node_bytes());
}

/// One ray's way through the tree step by step, without a clock: its memory accesses in order, and its work.
class FunctionalWalk {
  public:
    /// Puts the ray at the root; false: it is not to be traversed.
    [[nodiscard]] bool start(const model::MemoryImage& image, const model::Ray& ray, model::RayKind kind) {
        work_ = {.rays = 1};
        return model::start(traversal_, image, ray, kind);
    }
    [[nodiscard]] std::uint64_t address() const { return traversal_.current.ref.address(); }
    [[nodiscard]] std::uint32_t size_bytes(const model::MemoryImage& image) const {
        return fetched_bytes(image, traversal_.current.ref);
    }
    /// Visits the node or leaf that the ray is at; false: that was the last one.
    [[nodiscard]] bool step(const model::MemoryImage& image) {
        const model::NodeRef ref = traversal_.current.ref;
        if (ref.is_leaf()) {
            work_.leaf_visits += 1;
            for (std::uint32_t i = 0; i < ref.pair_count() && !is_satisfied(traversal_); ++i) {
                add(visit_pair(traversal_, image, i));
            }
        } else {
            work_.node_visits += 1;
            work_.box_tests += visit_node(traversal_, image).box_tests;
        }
        return !is_satisfied(traversal_) && pop(traversal_);
    }
    [[nodiscard]] const RayWork& work() const { return work_; }

  private:
    void add(const model::PairVisit& visit) {
        work_.pair_tests += 1;
        work_.triangle_tests += visit.triangle_tests;
        work_.survivor_pairs += visit.exact_tests > 0 ? 1 : 0;
        work_.survivors += visit.exact_tests;
        work_.better_hits += visit.better_hits;
        work_.side_tests += visit.side_tests;
    }

    model::Traversal traversal_;
    RayWork work_;
};

}  // namespace rtu::study
