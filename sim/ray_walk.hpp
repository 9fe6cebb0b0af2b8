#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/mailbox.hpp"
#include "model/memory_image.hpp"
#include "model/traversal.hpp"
#include "sim/ray_supply.hpp"
#include "traces/recorded_walk.hpp"

namespace rtu::sim {

/// A ray's way through the tree, step by step: asked of model/, or read from a traversal trace. The units see
/// no difference.
class RayWalk {
  public:
    /// Puts the ray at the root; false: it is not to be traversed. The image must outlive the walk. The ray's
    /// mailbox is empty. A recorded walk has every visit of a ray without a mailbox, so it may have any.
    [[nodiscard]] bool start(const model::MemoryImage& image, const SuppliedRay& ray, model::RayKind kind,
                             const model::MailboxOptions& mailbox) {
        image_ = &image;
        if (mailbox != mailbox_.options()) mailbox_ = model::Mailbox(mailbox);
        mailbox_.clear(image.has_shared_pairs());
        is_recorded_ = ray.recorded.chunk != nullptr;
        return is_recorded_ ? recorded_.start(ray.recorded) : model::start(computed_, image, ray.ray, kind);
    }
    /// The node or leaf that the ray is at.
    [[nodiscard]] model::NodeRef current() const {
        return is_recorded_ ? recorded_.current() : computed_.current.ref;
    }
    /// Children of a node, at most.
    [[nodiscard]] std::uint32_t node_width() const { return image_->width; }
    /// Boxes that a visit of the current inner node tests.
    [[nodiscard]] std::uint32_t child_count() const {
        return is_recorded_ ? recorded_.child_count() : model::child_count(*image_, computed_.current.ref);
    }
    void visit_node() {
        if (is_recorded_) {
            recorded_.visit_node();
        } else {
            model::visit_node(computed_, *image_);
        }
    }
    /// Tests pair `index` of the current leaf; pairs are tested in order.
    model::PairVisit visit_pair(std::uint32_t index) {
        return is_recorded_ ? recorded_.visit_pair() : model::visit_pair(computed_, *image_, index);
    }
    /// Asks the mailbox for the current leaf; a known one is left, and pop() goes on from there.
    [[nodiscard]] model::MailboxAnswer look_up() {
        const model::MailboxAnswer answer = mailbox_.look_up(current());
        if (is_recorded_ && answer == model::MailboxAnswer::Known) recorded_.skip_leaf();
        return answer;
    }
    /// As model::pop().
    [[nodiscard]] bool pop(std::size_t floor = 0) {
        return is_recorded_ ? recorded_.pop(floor) : model::pop(computed_, floor);
    }
    [[nodiscard]] std::size_t stack_size() const {
        return is_recorded_ ? recorded_.stack_size() : computed_.stack.size();
    }
    /// True when an any-hit ray has its answer.
    [[nodiscard]] bool is_satisfied() const {
        return is_recorded_ ? recorded_.is_satisfied() : model::is_satisfied(computed_);
    }
    /// What the ray hits, once it has come to its end.
    [[nodiscard]] std::optional<model::Hit> hit() const {
        if (is_recorded_) return recorded_.hit();
        return computed_.closest.is_found ? std::optional(computed_.closest.hit) : std::nullopt;
    }

  private:
    const model::MemoryImage* image_ = nullptr;
    bool is_recorded_ = false;
    model::Traversal computed_;
    traces::RecordedWalk recorded_;
    model::Mailbox mailbox_;
};

}  // namespace rtu::sim
