#include "sim/ray_source.hpp"

namespace rtu::sim {

RaySource::RaySource(sc_core::sc_module_name name, ClockDomain& domain, std::uint32_t ray_count,
                     std::uint32_t rays_per_cycle, std::uint32_t rtu_count)
    : ClockedUnit(name, domain),
      rays_out("rays_out", rtu_count),
      ray_count_(ray_count),
      rays_per_cycle_(rays_per_cycle) {}

Cycle RaySource::next_event(Cycle now) const { return next_ray_ < ray_count_ ? now + 1 : no_cycle; }

std::string RaySource::describe() const {
    return fmt::format("{} of {} rays handed over", next_ray_, ray_count_);
}

Activity RaySource::tick(Cycle now) {
    if (next_ray_ == ray_count_) return Activity::Waiting;
    const auto rtu_count = std::uint32_t(rays_out.size());
    std::uint32_t sent = 0;
    for (std::uint32_t tried = 0; tried < rtu_count && sent < rays_per_cycle_ && next_ray_ < ray_count_;
         ++tried) {
        auto& out = *rays_out[next_rtu_].operator->();
        next_rtu_ = next_rtu_ + 1 == rtu_count ? 0 : next_rtu_ + 1;
        if (!out.can_push(now)) continue;
        out.push(now, {next_ray_++});
        ++sent;
    }
    return sent > 0 ? Activity::Busy : Activity::Blocked;
}

}  // namespace rtu::sim
