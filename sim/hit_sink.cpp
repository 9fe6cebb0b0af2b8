#include "sim/hit_sink.hpp"

#include <utility>

#include "model/error.hpp"

namespace rtu::sim {

HitSink::HitSink(sc_core::sc_module_name name, ClockDomain& domain, HitConsumer consumer,
                 std::uint32_t rtu_count)
    : ClockedUnit(name, domain), hits_in("hits_in", rtu_count), consumer_(std::move(consumer)) {}

std::string HitSink::describe() const {
    return fmt::format("{} rays returned, the first {} of them without a gap", received_, next_);
}

Activity HitSink::tick(Cycle now) {
    Activity activity = Activity::Waiting;
    const std::uint32_t first = next_;
    for (auto& port : hits_in) {
        while (port->can_pop(now)) {
            take(port->pop(now));
            activity = Activity::Busy;
        }
    }
    if (next_ > first && finished_out.size() > 0) finished_out->push(now, {next_ - first});
    return activity;
}

void HitSink::take(const HitMessage& message) {
    const bool is_new = message.ray_index >= next_;
    const std::size_t place = message.ray_index - next_;
    RTU_CHECK(is_new && (place >= waiting_.size() || !waiting_[place]), "ray {} was returned twice",
              message.ray_index);
    if (place >= waiting_.size()) waiting_.resize(place + 1);
    waiting_[place] = message;
    ++received_;
    for (; !waiting_.empty() && waiting_.front(); ++next_) {
        consumer_(waiting_.front()->hit);
        waiting_.pop_front();
    }
}

}  // namespace rtu::sim
