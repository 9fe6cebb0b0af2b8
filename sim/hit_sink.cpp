#include "sim/hit_sink.hpp"

namespace rtu::sim {

HitSink::HitSink(sc_core::sc_module_name name, ClockDomain& domain, std::uint32_t ray_count,
                 std::uint32_t rtu_count)
    : ClockedUnit(name, domain),
      hits_in("hits_in", rtu_count),
      hits_(ray_count),
      is_received_(ray_count, false) {}

std::string HitSink::describe() const {
    return fmt::format("{} of {} rays returned", received_, is_received_.size());
}

Activity HitSink::tick(Cycle now) {
    Activity activity = Activity::Waiting;
    for (auto& port : hits_in) {
        while (port->can_pop(now)) {
            const HitMessage message = port->pop(now);
            RTU_CHECK(!is_received_[message.ray_index], "ray {} was returned twice", message.ray_index);
            is_received_[message.ray_index] = true;
            if (message.has_hit) hits_[message.ray_index] = message.hit;
            ++received_;
            activity = Activity::Busy;
        }
    }
    return activity;
}

}  // namespace rtu::sim
