#include "sim/box_unit.hpp"

#include <algorithm>

namespace rtu::sim {

BoxUnit::BoxUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu::Box& config,
                 RaySlots& slots)
    : ClockedUnit(name, domain),
      config_(config),
      slots_(slots),
      // Room for every node that can be on its way when each has one child only.
      pipeline_(config.latency_cycles, std::size_t(config.latency_cycles + 1) * config.boxes_per_cycle) {}

Cycle BoxUnit::next_event(Cycle now) const {
    return std::max(now + 1, lanes_free_at_ > now + 1 ? now + 1 : pipeline_.ready_at());
}

std::string BoxUnit::describe() const {
    return fmt::format("{} nodes waiting, {} in the pipeline", nodes_in->size(), pipeline_.size());
}

Activity BoxUnit::tick(Cycle now) {
    retire(now);
    return issue(now);
}

void BoxUnit::retire(Cycle now) {
    while (pipeline_.is_ready(now) && results_out->can_push(now)) results_out->push(now, pipeline_.pop());
}

Activity BoxUnit::issue(Cycle now) {
    if (lanes_free_at_ > now) {
        ++counters_.issue_cycles;
        return Activity::Busy;
    }
    std::uint32_t free_lanes = config_.boxes_per_cycle;
    while (free_lanes > 0 && nodes_in->can_pop(now) && !pipeline_.is_full()) {
        const SlotToken token{nodes_in->front().tag};
        RayWalk& walk = slots_[token.slot].walk;
        const std::uint32_t boxes = walk.child_count();
        const std::uint32_t lanes = config_.packs_nodes != 0 ? boxes : std::max(boxes, walk.node_width());
        const bool has_all_lanes = free_lanes == config_.boxes_per_cycle;
        if (lanes > free_lanes && !has_all_lanes) break;
        nodes_in->pop(now);
        const model::NodeVisit visit = walk.visit_node();
        ++counters_.node_visits;
        counters_.box_tests += boxes;
        counters_.box_hits += visit.box_hits;
        counters_.extra_box_hits += visit.extra_hits;
        const std::uint32_t last_cycle = (boxes - 1) / config_.boxes_per_cycle;
        lanes_free_at_ = now + last_cycle + 1;
        pipeline_.push(now + last_cycle, token);
        free_lanes -= std::min(free_lanes, lanes);
    }
    if (free_lanes < config_.boxes_per_cycle) {
        ++counters_.issue_cycles;
        return Activity::Busy;
    }
    return nodes_in->can_pop(now) ? Activity::Blocked : Activity::Waiting;
}

}  // namespace rtu::sim
