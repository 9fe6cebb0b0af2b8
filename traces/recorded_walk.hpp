#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "model/traversal.hpp"
#include "traces/visit_chunk.hpp"

namespace rtu::traces {

/// One ray of a chunk that stays in memory as long as anyone has a ray of it.
struct RecordedRay {
    std::shared_ptr<const VisitChunk> chunk;  ///< none: no recorded ray
    std::uint32_t index = 0;
};

/// A ray's traversal step by step, as recorded: what model::Traversal would do, without a node, a triangle or
/// any arithmetic. Entries of its stack are only counted. The chunk must be one that decode_visit_chunk() or
/// record_visits() gave.
class RecordedWalk {
  public:
    /// False: the ray is not traversed.
    [[nodiscard]] bool start(RecordedRay ray) {
        chunk_ = std::move(ray.chunk);
        ray_ = &chunk_->rays[ray.index];
        visit_ = chunk_->visits.data() + ray_->first_visit;
        pair_test_ = chunk_->pair_tests.data() + ray_->first_pair_test;
        visits_left_ = ray_->visit_count;
        pair_tests_left_ = visits_left_ > 0 && visit_->ref.is_leaf() ? visit_->tests : 0;
        entries_to_drop_ = visits_left_ > 0 ? visit_->dropped_entries : 0;
        stack_size_ = 0;
        return visits_left_ > 0;
    }
    [[nodiscard]] model::NodeRef current() const { return visit_->ref; }
    /// Boxes that the visit of the current inner node tests.
    [[nodiscard]] std::uint32_t child_count() const { return visit_->tests; }
    void visit_node() { stack_size_ += visit_->pushes; }
    /// The next pair of the current leaf.
    model::PairVisit visit_pair() {
        --pair_tests_left_;
        const PairTest test = *pair_test_++;
        return {test.triangle_tests, test.exact_tests, test.better_hits, test.side_tests};
    }
    /// Leaves the current leaf without a test: what the ray's mailbox saves. Only of a pair tested before, a
    /// test of which changed nothing when it was recorded.
    void skip_leaf() {
        pair_test_ += pair_tests_left_;
        pair_tests_left_ = 0;
    }
    /// As model::pop().
    [[nodiscard]] bool pop(std::size_t floor) {
        for (; stack_size_ > floor; --entries_to_drop_) {
            --stack_size_;
            if (entries_to_drop_ == 0) {
                advance();
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::size_t stack_size() const { return stack_size_; }
    [[nodiscard]] bool is_satisfied() const {
        return visits_left_ == 1 && pair_tests_left_ == 0 && visit_->ref.is_leaf() && ray_->hit &&
               chunk_->kind == model::RayKind::AnyHit;
    }
    [[nodiscard]] const std::optional<model::Hit>& hit() const { return ray_->hit; }

  private:
    void advance() {
        ++visit_;
        --visits_left_;
        pair_tests_left_ = visit_->ref.is_leaf() ? visit_->tests : 0;
        entries_to_drop_ = visit_->dropped_entries;
    }

    std::shared_ptr<const VisitChunk> chunk_;
    const WalkedRay* ray_ = nullptr;
    const Visit* visit_ = nullptr;
    const PairTest* pair_test_ = nullptr;
    std::uint32_t visits_left_ = 0;
    std::uint32_t pair_tests_left_ = 0;
    std::uint32_t entries_to_drop_ = 0;
    std::size_t stack_size_ = 0;
};

}  // namespace rtu::traces
