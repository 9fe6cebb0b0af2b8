#include "sim/rtu.hpp"

#include <algorithm>

namespace rtu::sim {

namespace {

// Deep enough to take what one cycle can bring and give it away in the next, for full rate.
std::size_t depth_for(std::uint32_t items_per_cycle) { return 2 * std::size_t(items_per_cycle); }

// A place is kept for every ray that the scheduler is deciding about.
std::size_t hits_depth(const Config::Rtu& config) {
    return depth_for(config.results_per_cycle + 1) +
           std::size_t(config.scheduler.latency_cycles) * config.results_per_cycle;
}

// An L2 may answer all that the L1 has outstanding; a flat memory keeps what the L1 cannot take.
std::size_t fill_depth(const Config& config) {
    return config.memory.model == MemoryModel::Flat ? flat_fill_depth : config.l1.mshrs;
}

}  // namespace

Rtu::Rtu(sc_core::sc_module_name name, ClockDomain& domain, const Config& config, std::uint32_t index,
         const RtuJob& job)
    : sc_core::sc_module(name),
      rays_in("rays", 2, domain),
      hits_out("hits", hits_depth(config.rtu), domain),
      fills_in("fills", fill_depth(config), domain),
      slots_(config.rtu.ray_slots),
      requests_("requests", depth_for(config.rtu.fetches_per_cycle), domain),
      nodes_("nodes", depth_for(config.l1.banks), domain),
      leaves_("leaves", depth_for(config.l1.banks), domain),
      stack_blocks_("stack_blocks", depth_for(config.l1.banks), domain),
      box_results_("box_results",
                   depth_for(std::max(config.rtu.box.boxes_per_cycle, config.rtu.results_per_cycle)), domain),
      pair_results_("pair_results",
                    depth_for(std::max(config.rtu.pair.testers, config.rtu.results_per_cycle)), domain),
      scheduler("scheduler", domain, config.rtu, job.image, job.kind, slots_, job.stacks, job.mailboxes),
      box("box", domain, config.rtu.box, slots_),
      pair("pair", domain, config.rtu.pair, slots_),
      l1("l1", domain, config.l1, 1, reply_channel_count, std::uint8_t(index)) {
    scheduler.rays_in(rays_in);
    scheduler.hits_out(hits_out);
    scheduler.requests_out(requests_);
    scheduler.box_results_in(box_results_);
    scheduler.pair_results_in(pair_results_);
    scheduler.stack_blocks_in(stack_blocks_);
    box.nodes_in(nodes_);
    box.results_out(box_results_);
    pair.leaves_in(leaves_);
    pair.results_out(pair_results_);
    l1.requests_in[0](requests_);
    l1.replies_out[std::size_t(ReplyTo::BoxUnit)](nodes_);
    l1.replies_out[std::size_t(ReplyTo::PairUnit)](leaves_);
    l1.replies_out[std::size_t(ReplyTo::Scheduler)](stack_blocks_);
    l1.fills_in(fills_in);
}

void Rtu::check_drained() const {
    scheduler.check_drained();
    const SchedulerCounters& s = scheduler.counters();
    RTU_CHECK(s.node_fetches == box.counters().node_visits, "{}: {} nodes fetched, {} tested", name(),
              s.node_fetches, box.counters().node_visits);
    RTU_CHECK(s.leaf_fetches == pair.counters().leaf_visits, "{}: {} leaves fetched, {} tested", name(),
              s.leaf_fetches, pair.counters().leaf_visits);
    pair.check_drained();
    l1.check_drained();
    RTU_CHECK(rays_in.size() + hits_out.size() + requests_.size() + fills_in.size() + nodes_.size() +
                      leaves_.size() + stack_blocks_.size() + box_results_.size() + pair_results_.size() ==
                  0,
              "{}: a channel is not empty at the end", name());
}

}  // namespace rtu::sim
