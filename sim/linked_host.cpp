#include "sim/linked_host.hpp"

#include <algorithm>

namespace rtu::sim {

LinkedHost::LinkedHost(sc_core::sc_module_name name, ClockDomain& domain, const Config& config,
                       BatchSupply& batches)
    : sc_core::sc_module(name),
      arrivals("arrivals", std::max(2U, config.link.buffers), domain),
      finished("finished", 2, domain),
      transfers_("transfers", 2, domain),
      replies_("replies", std::max(2U, config.link.buffers), domain),
      host_("host", domain, config.link, batches, timeline_),
      link_("link", domain, config.link, config.clock_mhz, timeline_),
      initiator_("initiator"),
      target_("target", {}) {
    host_.transfers_out(initiator_);
    initiator_.replies_out(replies_);
    host_.replies_in(replies_);
    host_.finished_in(finished);
    target_.requests_out(transfers_);
    link_.transfers_in(transfers_);
    link_.replies_out(target_);
    link_.arrivals_out(arrivals);
    connect(initiator_, target_);
}

LinkTime LinkedHost::check_drained(Cycle cycles) {
    link_.check_drained();
    RTU_CHECK(arrivals.size() + finished.size() + transfers_.size() + replies_.size() == 0,
              "{}: a channel is not empty at the end", name());
    const LinkTime time = timeline_.time_until(cycles);
    RTU_CHECK(time.total() == cycles, "{}: {} cycles accounted for, {} simulated", name(), time.total(),
              cycles);
    return time;
}

std::vector<UnitResult> LinkedHost::results(const LinkTime& time) const {
    std::vector<CounterValue> counters = counter_values(link_counter_rows, link_.counters());
    for (const CounterValue& value : counter_values(link_time_rows, time)) counters.push_back(value);
    return {{"host", host_.cycle_account(), {{"batches", "batches", host_.batch_count()}}},
            {"link", link_.cycle_account(), counters}};
}

Cycle transfer_cycles(const Config& config, std::uint64_t bytes) {
    const std::uint64_t slower = std::min(config.link.up_mb_per_second, config.link.down_mb_per_second);
    return cycles_of_ns(config.link.overhead_ns, config.clock_mhz) +
           cycles_of_ns(config.link.latency_ns, config.clock_mhz) + bytes * config.clock_mhz / slower + 1;
}

}  // namespace rtu::sim
