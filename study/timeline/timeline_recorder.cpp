#include "study/timeline/timeline_recorder.hpp"

#include <algorithm>
#include <utility>

#include "model/error.hpp"

namespace rtu::study {

namespace {

using sim::Cycle;

UnitState state_of(sim::Activity activity, bool has_worked, bool is_last) {
    if (activity == sim::Activity::Busy) return UnitState::Busy;
    if (activity == sim::Activity::Blocked) return UnitState::Blocked;
    return has_worked && !is_last ? UnitState::Starved : UnitState::Idle;
}

SlotWait wait_of(RequestSpan::Kind kind) {
    if (kind == RequestSpan::Kind::Node) return SlotWait::NodeFetch;
    return kind == RequestSpan::Kind::Leaf ? SlotWait::LeafFetch : SlotWait::StackFetch;
}

template <class T, class F>
void for_each_pushed(const sim::Fifo<T>& channel, Cycle now, F f) {
    for (std::size_t i = 0; i < channel.pushed(now); ++i) f(channel.pushed_item(i));
}

RequestSpan begun(std::uint32_t rtu, RequestSpan::Kind kind, const sim::MemoryRequest& request, Cycle now) {
    RequestSpan span;
    span.rtu = rtu;
    span.kind = kind;
    span.is_write = request.is_write;
    span.address = request.address;
    span.size_bytes = request.size_bytes;
    span.begin = span.end = now;
    return span;
}

}  // namespace

TimelineRecorder::TimelineRecorder(const TimelineWindow& window) : window_(window) {
    timeline_.window = window;
}

// Spans that the window has something of.
template <class Span>
void TimelineRecorder::add(std::vector<Span>& spans, Span span) const {
    span.begin = std::max(span.begin, window_.from);
    span.end = std::min(span.end, window_.end());
    if (span.begin < span.end) spans.push_back(span);
}

void TimelineRecorder::add_write(const RequestSpan& write) {
    if (window_.from <= write.begin && write.begin < window_.end()) timeline_.requests.push_back(write);
}

void TimelineRecorder::attach(const sim::MachineView& machine) {
    for (const sim::ClockedUnit* unit : machine.domain.units()) {
        timeline_.units.emplace_back(unit->name());
        units_.push_back({unit, {}, sim::Activity::Waiting, false, 0});
    }
    for (const sim::RtuView& view : machine.rtus) {
        rtus_.push_back({view, std::vector<Slot>(view.rtu.channels().slots.size()), {}, 0, {}});
    }
    timeline_.rtu_count = std::uint32_t(rtus_.size());
    timeline_.slots_per_rtu = std::uint32_t(rtus_.front().slots.size());
    for (const sim::NamedChannel& named : machine.channels) {
        timeline_.channels.push_back({named.name, std::uint32_t(named.channel->depth())});
        channels_.push_back({named.channel, {}, false});
    }
}

void TimelineRecorder::after(Cycle begin, Cycle end) {
    watch_units(begin);
    watch_channels(begin, end);
    for (std::uint32_t i = 0; i < rtus_.size(); ++i) watch_rtu(i, begin);
}

void TimelineRecorder::watch_units(Cycle begin) {
    for (std::uint32_t i = 0; i < units_.size(); ++i) {
        Unit& unit = units_[i];
        const sim::Activity activity = unit.unit->activity_since(unit.before);
        unit.before = unit.unit->cycle_account();
        if (activity == unit.activity) continue;
        close(i, begin, false);
        unit.activity = activity;
        unit.has_worked = true;  // it works now, or did just before
        unit.since = begin;
    }
}

void TimelineRecorder::close(std::uint32_t index, Cycle end, bool is_last) {
    const Unit& unit = units_[index];
    add(timeline_.unit_spans,
        UnitSpan{index, state_of(unit.activity, unit.has_worked, is_last), unit.since, end});
}

void TimelineRecorder::watch_channels(Cycle begin, Cycle end) {
    // Of several cycles, in which all channels are empty, the first tells of all.
    const Cycle now = std::max(begin, window_.from);
    if (now >= std::min(end, window_.end())) return;
    for (std::uint32_t i = 0; i < channels_.size(); ++i) {
        Channel& channel = channels_[i];
        const sim::ChannelView& view = *channel.view;
        ChannelSample sample{now, i, 0, std::uint32_t(view.pushed(now)), std::uint32_t(view.popped(now))};
        sample.held = std::uint32_t(view.size()) + sample.popped - sample.pushed;
        const ChannelSample& last = channel.last;
        const bool is_same =
            sample.held == last.held && sample.pushed == last.pushed && sample.popped == last.popped;
        if (channel.is_known && is_same) continue;
        channel.last = sample;
        channel.is_known = true;
        timeline_.samples.push_back(sample);
    }
}

// The order within a cycle is that of the scheduler: results, hits, requests, and last the new ray, which may
// take the slot of one that has just ended.
void TimelineRecorder::watch_rtu(std::uint32_t index, Cycle now) {
    watch_misses(index, now);
    watch_replies(index, now);
    watch_hits(index, now);
    watch_requests(index, now);
    accept(index, now);
}

void TimelineRecorder::watch_replies(std::uint32_t index, Cycle now) {
    const sim::RtuChannels channels = rtus_[index].view.rtu.channels();
    const auto reply = [&](std::uint32_t slot, SlotWait next) {
        RequestSpan request = rtus_[index].slots[slot].request;
        request.end = now;
        add(timeline_.requests, request);
        wait_for(index, slot, next, now);
    };
    for_each_pushed(channels.nodes, now, [&](const auto& r) { reply(r.tag, SlotWait::BoxUnit); });
    for_each_pushed(channels.leaves, now, [&](const auto& r) { reply(r.tag, SlotWait::PairUnit); });
    for_each_pushed(channels.stack_blocks, now, [&](const auto& r) { reply(r.tag, SlotWait::Scheduler); });
    const auto to_scheduler = [&](const sim::SlotToken& token) {
        wait_for(index, token.slot, SlotWait::Scheduler, now);
    };
    for_each_pushed(channels.box_results, now, to_scheduler);
    for_each_pushed(channels.pair_results, now, to_scheduler);
}

void TimelineRecorder::watch_requests(std::uint32_t index, Cycle now) {
    for_each_pushed(rtus_[index].view.rtu.channels().requests, now, [&](const sim::MemoryRequest& request) {
        const auto kind = RequestSpan::Kind(request.source);
        RequestSpan span = begun(index, kind, request, now);
        span.slot = request.tag;
        if (request.is_write) return add_write(span);
        rtus_[index].slots[request.tag].request = span;
        wait_for(index, request.tag, wait_of(kind), now);
    });
}

void TimelineRecorder::watch_misses(std::uint32_t index, Cycle now) {
    Rtu& rtu = rtus_[index];
    for_each_pushed(rtu.view.rtu.fills_in, now, [&](const sim::MemoryReply& reply) {
        const auto found = rtu.misses.find(reply.address);
        RTU_CHECK(found != rtu.misses.end(), "timeline: a fill of address {} that nobody asked for",
                  reply.address);
        found->second.end = now;
        add(timeline_.requests, found->second);
        rtu.misses.erase(found);
    });
    for_each_pushed(rtu.view.l1_requests, now, [&](const sim::MemoryRequest& request) {
        const RequestSpan span = begun(index, RequestSpan::Kind::L1Miss, request, now);
        if (request.is_write) return add_write(span);
        rtu.misses.insert_or_assign(request.address, span);
    });
}

void TimelineRecorder::watch_hits(std::uint32_t index, Cycle now) {
    Rtu& rtu = rtus_[index];
    for_each_pushed(rtu.view.rtu.channels().hits, now, [&](const sim::HitMessage& hit) {
        const auto found = rtu.slot_of.find(hit.ray_index);
        if (found == rtu.slot_of.end()) return;  // in and out in this cycle: a ray that is not traversed
        Slot& slot = rtu.slots[found->second];
        wait_for(index, found->second, SlotWait::Scheduler, now);
        add(timeline_.slot_spans, SlotSpan{index, found->second, slot.ray, slot.wait, slot.since, now});
        add(timeline_.ray_spans, RaySpan{index, found->second, slot.ray, slot.accepted, now});
        slot.is_used = false;
        rtu.slot_of.erase(found);
    });
}

void TimelineRecorder::accept(std::uint32_t index, Cycle now) {
    Rtu& rtu = rtus_[index];
    const std::uint64_t accepted = rtu.view.rtu.scheduler.counters().rays_accepted;
    if (accepted == rtu.accepted) return;
    rtu.accepted = accepted;
    const sim::RaySlots& slots = rtu.view.rtu.channels().slots;
    for (std::uint32_t i = 0; i < slots.size(); ++i) {
        const sim::RaySlot& slot = slots[i];
        if (slot.accepted_cycle != now || rtu.slots[i].is_used) continue;
        bool is_over = false;
        for_each_pushed(rtu.view.rtu.channels().hits, now,
                        [&](const sim::HitMessage& hit) { is_over |= hit.ray_index == slot.ray_index; });
        if (is_over) continue;
        Slot& mine = rtu.slots[i];
        mine.is_used = true;
        mine.ray = slot.ray_index;
        mine.wait = SlotWait::Scheduler;
        mine.accepted = mine.since = now;
        rtu.slot_of.emplace(slot.ray_index, i);
    }
}

void TimelineRecorder::wait_for(std::uint32_t index, std::uint32_t slot, SlotWait wait, Cycle now) {
    Slot& mine = rtus_[index].slots[slot];
    if (mine.wait == wait) return;
    if (mine.since < now) {
        add(timeline_.slot_spans, SlotSpan{index, slot, mine.ray, mine.wait, mine.since, now});
    }
    mine.wait = wait;
    mine.since = now;
}

Timeline TimelineRecorder::finish(Cycle run_cycles) {
    for (std::uint32_t i = 0; i < units_.size(); ++i) close(i, run_cycles, true);
    for (const Rtu& rtu : rtus_) {
        RTU_CHECK(rtu.slot_of.empty(), "timeline: {} rays have not ended", rtu.slot_of.size());
        RTU_CHECK(rtu.misses.empty(), "timeline: {} misses were not answered", rtu.misses.size());
    }
    timeline_.run_cycles = run_cycles;
    return std::move(timeline_);
}

}  // namespace rtu::study
