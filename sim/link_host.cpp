#include "sim/link_host.hpp"

#include <limits>

#include "model/error.hpp"

namespace rtu::sim {

namespace {

std::uint32_t transfer_size(std::uint64_t bytes) {
    RTU_CHECK(bytes <= std::numeric_limits<std::uint32_t>::max(), "a transfer of {} bytes", bytes);
    return std::uint32_t(bytes);
}

}  // namespace

LinkHost::LinkHost(sc_core::sc_module_name name, ClockDomain& domain, const Config::Link& config,
                   BatchSupply& batches, LinkTimeline& timeline)
    : ClockedUnit(name, domain),
      batches_(batches),
      timeline_(timeline),
      buffers_(config.buffers),
      next_batch_(batches.next_batch()) {}

Cycle LinkHost::next_event(Cycle now) const { return can_send() || !to_read_.empty() ? now + 1 : no_cycle; }

std::string LinkHost::describe() const {
    return fmt::format("{} batches sent, {} complete, {}", sent_batches_, completed_,
                       next_batch_ ? "more to come" : "none left");
}

Activity LinkHost::tick(Cycle now) {
    const bool has_taken = take_replies(now) | take_finished(now);
    const bool has_pushed = push_transfers(now);
    if (has_taken || has_pushed) return Activity::Busy;
    return can_send() || !to_read_.empty() ? Activity::Blocked : Activity::Waiting;
}

bool LinkHost::take_replies(Cycle now) {
    bool has_taken = false;
    while (replies_in->can_pop(now)) {
        const MemoryReply reply = replies_in->pop(now);
        RTU_CHECK(!reading_.empty() && reply.address == reading_.front().index,
                  "{}: the results of batch {} came out of turn", name(), reply.address);
        reading_.pop_front();
        complete_batch();
        has_taken = true;
    }
    return has_taken;
}

bool LinkHost::take_finished(Cycle now) {
    bool has_taken = false;
    while (finished_in->can_pop(now)) {
        finished_items_ += finished_in->pop(now).count;
        has_taken = true;
    }
    while (!sent_.empty() && sent_.front().last_item <= finished_items_) {
        timeline_.end(LinkTimeline::Stage::Machine, now);
        if (sent_.front().down_bytes > 0) {
            to_read_.push_back(sent_.front());
        } else {
            complete_batch();
        }
        sent_.pop_front();
    }
    return has_taken;
}

bool LinkHost::push_transfers(Cycle now) {
    bool has_pushed = false;
    while (!to_read_.empty() && transfers_out->can_push(now)) {
        const Sent& batch = to_read_.front();
        transfers_out->push(now, {.address = batch.index, .size_bytes = batch.down_bytes});
        reading_.push_back(batch);
        to_read_.pop_front();
        has_pushed = true;
    }
    while (can_send() && transfers_out->can_push(now)) {
        send_batch(now);
        has_pushed = true;
    }
    return has_pushed;
}

void LinkHost::send_batch(Cycle now) {
    const LinkBatch& batch = *next_batch_;
    sent_items_ += batch.items;
    transfers_out->push(
        now, {.address = sent_batches_, .size_bytes = transfer_size(batch.up_bytes), .is_write = true});
    sent_.push_back({sent_batches_, sent_items_, transfer_size(batch.down_bytes)});
    ++sent_batches_;
    ++under_way_;
    next_batch_ = batches_.next_batch();
}

void LinkHost::complete_batch() {
    ++completed_;
    --under_way_;
}

}  // namespace rtu::sim
