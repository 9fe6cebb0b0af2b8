#include "sim/ray_source.hpp"

#include <limits>

#include "model/error.hpp"

namespace rtu::sim {

RaySource::RaySource(sc_core::sc_module_name name, ClockDomain& domain, RaySupply& rays,
                     std::uint32_t rays_per_cycle, std::uint32_t rtu_count)
    : ClockedUnit(name, domain),
      rays_out("rays_out", rtu_count),
      rays_(rays),
      rays_per_cycle_(rays_per_cycle),
      next_ray_(rays.next()) {}

void RaySource::end_of_elaboration() {
    if (arrivals_in.size() == 0) arrived_ = std::numeric_limits<std::uint64_t>::max();
}

Cycle RaySource::next_event(Cycle now) const {
    return next_ray_ && ray_count_ < arrived_ ? now + 1 : no_cycle;
}

std::string RaySource::describe() const {
    return fmt::format("{} rays handed over, {}", ray_count_, next_ray_ ? "more to come" : "none left");
}

void RaySource::take_next_ray() {
    next_ray_ = rays_.next();
    ++ray_count_;
    // One value is kept free, so that counts of rays fit as well.
    RTU_CHECK(!next_ray_ || ray_count_ < std::numeric_limits<std::uint32_t>::max() - 1,
              "more than {} rays in one simulation", ray_count_);
}

void RaySource::take_arrivals(Cycle now) {
    while (arrivals_in->can_pop(now)) arrived_ += arrivals_in->pop(now).bytes / ray_bytes;
}

Activity RaySource::tick(Cycle now) {
    if (arrivals_in.size() > 0) take_arrivals(now);
    const auto has_ray = [this] { return next_ray_ && ray_count_ < arrived_; };
    if (!has_ray()) return Activity::Waiting;
    const auto rtu_count = std::uint32_t(rays_out.size());
    std::uint32_t sent = 0;
    for (std::uint32_t tried = 0; tried < rtu_count && sent < rays_per_cycle_ && has_ray(); ++tried) {
        auto& out = *rays_out[next_rtu_].operator->();
        next_rtu_ = next_rtu_ + 1 == rtu_count ? 0 : next_rtu_ + 1;
        if (!out.can_push(now)) continue;
        out.push(now, {ray_count_, *next_ray_});
        take_next_ray();
        ++sent;
    }
    return sent > 0 ? Activity::Busy : Activity::Blocked;
}

}  // namespace rtu::sim
