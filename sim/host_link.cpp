#include "sim/host_link.hpp"

#include <algorithm>

namespace rtu::sim {

namespace {

// Without a link time stands still: nothing takes a cycle.
std::uint32_t clock_of(const Config::Link& config, std::uint32_t clock_mhz) {
    return config.count == 0 ? 0 : clock_mhz;
}

}  // namespace

HostLink::HostLink(sc_core::sc_module_name name, ClockDomain& domain, const Config::Link& config,
                   std::uint32_t clock_mhz, LinkTimeline& timeline)
    : ClockedUnit(name, domain),
      config_(config),
      overhead_cycles_(cycles_of_ns(config.overhead_ns, clock_of(config, clock_mhz))),
      latency_cycles_(cycles_of_ns(config.latency_ns, clock_of(config, clock_mhz))),
      timeline_(timeline),
      wires_(config.wires, LinkWire(clock_of(config, clock_mhz))) {}

Cycle HostLink::next_event(Cycle now) const {
    Cycle next = no_cycle;
    const auto consider = [&](Cycle at) {
        if (at > now) next = std::min(next, at);
    };
    consider(host_free_at_);
    for (const LinkWire& wire : wires_) consider(wire.free_at());
    for (const auto* direction : {&up_, &down_}) {
        if (!direction->empty()) consider(std::max(now + 1, direction->front().arrives_at));
    }
    return next;
}

std::string HostLink::describe() const {
    return fmt::format("{} transfers up and {} down under way", up_.size(), down_.size());
}

Activity HostLink::tick(Cycle now) {
    const bool has_delivered = deliver(now);
    const bool has_accepted = accept(now);
    if (has_delivered || has_accepted || is_working_after(now)) return Activity::Busy;
    const bool is_held_up = transfers_in->can_pop(now) || (!up_.empty() && up_.front().arrives_at <= now) ||
                            (!down_.empty() && down_.front().arrives_at <= now);
    return is_held_up ? Activity::Blocked : Activity::Waiting;
}

Activity HostLink::between_events(Cycle now) const {
    return is_working_after(now) ? Activity::Busy : Activity::Waiting;
}

bool HostLink::is_working_after(Cycle now) const {
    return host_free_at_ > now ||
           std::ranges::any_of(wires_, [now](const LinkWire& wire) { return wire.free_at() > now; });
}

bool HostLink::deliver(Cycle now) {
    bool has_delivered = false;
    while (!up_.empty() && up_.front().arrives_at <= now && arrivals_out->can_push(now)) {
        const MemoryRequest transfer = up_.front().transfer;
        arrivals_out->push(now, {transfer.address, transfer.size_bytes});
        counters_.up_bytes_arrived += transfer.size_bytes;
        timeline_.end(LinkTimeline::Stage::Upload, now);
        timeline_.begin(LinkTimeline::Stage::Machine, now);
        up_.pop_front();
        has_delivered = true;
    }
    while (!down_.empty() && down_.front().arrives_at <= now && replies_out->can_push(now)) {
        const MemoryRequest transfer = down_.front().transfer;
        replies_out->push(now, {transfer.address, transfer.tag});
        counters_.down_bytes_arrived += transfer.size_bytes;
        timeline_.end(LinkTimeline::Stage::ReadBack, now);
        down_.pop_front();
        has_delivered = true;
    }
    return has_delivered;
}

bool HostLink::accept(Cycle now) {
    bool has_accepted = false;
    while (transfers_in->can_pop(now) && in_flight() < config_.outstanding) {
        start(now, transfers_in->pop(now));
        has_accepted = true;
    }
    if (transfers_in->can_pop(now)) ++counters_.outstanding_full_cycles;
    return has_accepted;
}

// Everything that a transfer waits for is in order, so its whole way is known when it is accepted.
void HostLink::start(Cycle now, const MemoryRequest& transfer) {
    const bool is_up = transfer.is_write;
    host_free_at_ = std::max(host_free_at_, now) + overhead_cycles_;
    LinkWire& wire = is_up ? wires_.front() : wires_.back();
    const Cycle sent_at = wire.send(host_free_at_, transfer.size_bytes,
                                    is_up ? config_.up_mb_per_second : config_.down_mb_per_second);
    (is_up ? up_ : down_).push_back({sent_at + latency_cycles_, transfer});
    ++(is_up ? counters_.up_transfers : counters_.down_transfers);
    (is_up ? counters_.up_bytes : counters_.down_bytes) += transfer.size_bytes;
    counters_.overhead_cycles += overhead_cycles_;
    timeline_.begin(is_up ? LinkTimeline::Stage::Upload : LinkTimeline::Stage::ReadBack, now);
}

void HostLink::check_drained() const {
    RTU_CHECK(in_flight() == 0, "{}: {} transfers have not arrived", name(), in_flight());
    RTU_CHECK(counters_.up_bytes == counters_.up_bytes_arrived &&
                  counters_.down_bytes == counters_.down_bytes_arrived,
              "{}: {} and {} bytes accepted, {} and {} arrived", name(), counters_.up_bytes,
              counters_.down_bytes, counters_.up_bytes_arrived, counters_.down_bytes_arrived);
}

}  // namespace rtu::sim
