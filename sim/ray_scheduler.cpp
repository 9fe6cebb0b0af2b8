#include "sim/ray_scheduler.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace rtu::sim {

RayScheduler::RayScheduler(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu& config,
                           const model::MemoryImage& image, model::RayKind kind, RaySlots& slots,
                           model::StackRegion region, MailboxRegion mailboxes)
    : ClockedUnit(name, domain),
      config_(config),
      spill_block_(model::spill_block_size(config.stack_entries)),
      node_bytes_(image.node_bytes()),
      image_(image),
      kind_(kind),
      slots_(slots),
      region_(region),
      deciding_(config.scheduler.latency_cycles,
                std::size_t(config.scheduler.latency_cycles + 1) * config.results_per_cycle),
      mailboxes_(mailboxes),
      mailbox_(config.mailbox),
      looks_up_(mailbox_.is_on() || image.has_shared_pairs()) {
    for (auto slot = std::uint32_t(slots.size()); slot-- > 0;) free_slots_.push_back(slot);
}

Cycle RayScheduler::next_event(Cycle now) const {
    return queued_.empty() && passed_.empty() ? std::max(now + 1, deciding_.ready_at()) : now + 1;
}

std::string RayScheduler::describe() const {
    return fmt::format("{} of {} slots in use, {} requests queued, {} box and {} pair results waiting",
                       slots_.size() - free_slots_.size(), slots_.size(), queued_.size(),
                       box_results_in->size(), pair_results_in->size());
}

void RayScheduler::check_drained() const {
    const SchedulerCounters& c = counters_;
    RTU_CHECK(c.rays_accepted == c.rays_finished, "{}: {} rays in, {} out", name(), c.rays_accepted,
              c.rays_finished);
    RTU_CHECK(
        free_slots_.size() == slots_.size() && queued_.empty() && passed_.empty() && deciding_.is_empty(),
        "{}: not drained: {}", name(), describe());
    RTU_CHECK(c.reloaded_entries == c.spilled_entries ||
                  (kind_ == model::RayKind::AnyHit && c.reloaded_entries < c.spilled_entries),
              "{}: {} stack entries spilled, {} read back", name(), c.spilled_entries, c.reloaded_entries);
}

bool RayScheduler::has_work(Cycle now) const {
    return !queued_.empty() || !passed_.empty() || box_results_in->can_pop(now) ||
           pair_results_in->can_pop(now) || stack_blocks_in->can_pop(now) ||
           (rays_in->can_pop(now) && !free_slots_.empty());
}

Activity RayScheduler::tick(Cycle now) {
    const bool has_taken = take(now);
    const bool has_decided = decide(now);
    const bool has_issued = issue(now);
    const bool has_accepted = accept(now);
    if (has_taken || has_decided || has_issued || has_accepted) return Activity::Busy;
    return has_work(now) ? Activity::Blocked : Activity::Waiting;
}

bool RayScheduler::take(Cycle now) {
    std::uint32_t taken = 0;
    for (; !passed_.empty() && taken < config_.results_per_cycle && can_take_more(now); ++taken) {
        deciding_.push(now, {passed_.front()});
        passed_.pop_front();
    }
    // The one that is asked first changes whenever something was taken, so that none can starve.
    for (std::uint32_t i = 0; i < reply_channel_count; ++i) {
        const std::uint32_t source = (first_source_ + i) % reply_channel_count;
        while (taken < config_.results_per_cycle && can_take_more(now)) {
            const std::optional<Result> result = next_result(source, now);
            if (!result) break;
            deciding_.push(now, *result);
            ++taken;
            if (result->is_from_memory) break;  // a wide word: one a cycle
        }
    }
    if (taken > 0) first_source_ = (first_source_ + 1) % reply_channel_count;
    return taken > 0;
}

// Every ray under way may hand a hit out.
bool RayScheduler::can_take_more(Cycle now) const { return hits_out->space(now) > deciding_.size(); }

std::optional<RayScheduler::Result> RayScheduler::next_result(std::uint32_t source, Cycle now) {
    if (source == 0 && pair_results_in->can_pop(now)) return Result{pair_results_in->pop(now).slot};
    if (source == 1 && box_results_in->can_pop(now)) return Result{box_results_in->pop(now).slot};
    if (source == 2 && stack_blocks_in->can_pop(now)) return Result{stack_blocks_in->pop(now).tag, true};
    return std::nullopt;
}

bool RayScheduler::decide(Cycle now) {
    if (!deciding_.is_ready(now)) return false;
    while (deciding_.is_ready(now)) {
        const Result result = deciding_.pop();
        if (!result.is_from_memory) {
            advance(result.slot, now);
        } else if (slots_[result.slot].waits_for_word) {
            use_word(result.slot, now);
        } else {
            use_stack_block(result.slot, now);
        }
    }
    return true;
}

// Decides what a ray does next, once its last request has been worked on.
void RayScheduler::advance(std::uint32_t slot, Cycle now) {
    RaySlot& ray = slots_[slot];
    const bool is_satisfied = ray.walk.is_satisfied();
    if (!is_satisfied && ray.walk.pop(ray.spilled)) {
        if (looks_up_ && ray.walk.current().is_leaf()) {
            look_up(slot);
        } else {
            queue_fetch(slot);
        }
    } else if (!is_satisfied && ray.spilled > 0) {
        queue_reload(slot);
    } else {
        finish(slot, now);
    }
}

void RayScheduler::use_stack_block(std::uint32_t slot, Cycle now) {
    slots_[slot].spilled -= spill_block_;
    counters_.reloaded_entries += spill_block_;
    advance(slot, now);
}

// Asks the ray's mailbox for the leaf that it has come to.
void RayScheduler::look_up(std::uint32_t slot) {
    RaySlot& ray = slots_[slot];
    const model::NodeRef leaf = ray.walk.current();
    ray.answer = ray.walk.look_up();
    mailbox_counters_.lookups += mailbox_.is_on() ? 1 : 0;
    mailbox_counters_.duplicates += ray.answer == model::MailboxAnswer::Again ? leaf.pair_count() : 0;
    if (mailbox_.kind == model::MailboxKind::PerPair) {
        ray.waits_for_word = true;
        queue_word(slot, false);
    } else if (ray.answer == model::MailboxAnswer::Known) {
        count_known(leaf);
        passed_.push_back(slot);
    } else {
        queue_fetch(slot);
    }
}

void RayScheduler::use_word(std::uint32_t slot, Cycle now) {
    RaySlot& ray = slots_[slot];
    ray.waits_for_word = false;
    if (ray.answer == model::MailboxAnswer::Known) {
        count_known(ray.walk.current());
        advance(slot, now);
    } else {
        queue_word(slot, true);
        queue_fetch(slot);
    }
}

void RayScheduler::count_known(model::NodeRef leaf) {
    ++mailbox_counters_.hits;
    mailbox_counters_.bytes_saved += std::uint64_t(leaf.pair_count()) * model::image_block_bytes;
}

void RayScheduler::finish(std::uint32_t slot, Cycle now) {
    const RaySlot& ray = slots_[slot];
    hits_out->push(now, {ray.ray_index, ray.walk.hit()});
    ++counters_.rays_finished;
    counters_.slot_cycles += now - ray.accepted_cycle;
    free_slots_.push_back(slot);
}

void RayScheduler::queue_fetch(std::uint32_t slot) {
    const RaySlot& ray = slots_[slot];
    while (ray.walk.stack_size() - ray.spilled > config_.stack_entries) queue_spill(slot);
    const model::NodeRef ref = ray.walk.current();
    const std::uint64_t bytes =
        ref.is_leaf() ? std::uint64_t(ref.pair_count()) * model::image_block_bytes : node_bytes_;
    const ReplyTo target = ref.is_leaf() ? ReplyTo::PairUnit : ReplyTo::BoxUnit;
    queued_.push_back({.address = ref.address(),
                       .size_bytes = std::uint32_t(bytes),
                       .tag = slot,
                       .source = std::uint8_t(target)});
    ++(ref.is_leaf() ? counters_.leaf_fetches : counters_.node_fetches);
    (ref.is_leaf() ? counters_.leaf_fetch_bytes : counters_.node_fetch_bytes) += bytes;
}

void RayScheduler::queue_spill(std::uint32_t slot) {
    RaySlot& ray = slots_[slot];
    queued_.push_back(stack_request(slot, ray.spilled, true));
    ray.spilled += spill_block_;
    counters_.spilled_entries += spill_block_;
}

void RayScheduler::queue_reload(std::uint32_t slot) {
    queued_.push_back(stack_request(slot, slots_[slot].spilled - spill_block_, false));
}

void RayScheduler::queue_word(std::uint32_t slot, bool is_write) {
    queued_.push_back({.address = mailboxes_.word_address(slot, slots_[slot].walk.current()),
                       .size_bytes = mailbox_word_bytes,
                       .tag = slot,
                       .source = std::uint8_t(ReplyTo::Scheduler),
                       .is_write = is_write});
    (is_write ? mailbox_counters_.bytes_written : mailbox_counters_.bytes_read) += mailbox_word_bytes;
}

MemoryRequest RayScheduler::stack_request(std::uint32_t slot, std::size_t first_entry, bool is_write) const {
    const std::size_t block = first_entry / spill_block_;
    return {.address = region_.base_address + slot * region_.slot_bytes + block * model::spill_block_bytes,
            .size_bytes = model::spill_block_bytes,
            .tag = slot,
            .source = std::uint8_t(ReplyTo::Scheduler),
            .is_write = is_write};
}

bool RayScheduler::issue(Cycle now) {
    std::uint32_t sent = 0;
    bool has_written = false;  // stack blocks and words of mailboxes leave one a cycle
    while (sent < config_.fetches_per_cycle && !queued_.empty() && requests_out->can_push(now)) {
        if (queued_.front().is_write && has_written) break;
        has_written |= queued_.front().is_write;
        requests_out->push(now, queued_.front());
        queued_.pop_front();
        ++sent;
    }
    return sent > 0;
}

bool RayScheduler::accept(Cycle now) {
    if (free_slots_.empty() || !rays_in->can_pop(now) || !can_take_more(now)) return false;
    const std::uint32_t slot = free_slots_.back();
    free_slots_.pop_back();
    RaySlot& ray = slots_[slot];
    const RayMessage message = rays_in->pop(now);
    ray.ray_index = message.ray_index;
    ray.spilled = 0;
    ray.accepted_cycle = now;
    ++counters_.rays_accepted;
    if (ray.walk.start(image_, message.ray, kind_, mailbox_)) {
        queue_fetch(slot);
    } else {
        finish(slot, now);
    }
    return true;
}

}  // namespace rtu::sim
