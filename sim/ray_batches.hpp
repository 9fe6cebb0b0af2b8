#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

#include "sim/link_host.hpp"
#include "sim/link_message.hpp"
#include "sim/ray_supply.hpp"

namespace rtu::sim {

/// Rays that a host sends in batches. The host takes batches, the machine takes their rays, and both see the
/// same rays in the same order, whoever asks first; at most a batch more than the machine has taken is held.
class RayBatches final : public RaySupply, public BatchSupply {
  public:
    RayBatches(RaySupply& rays, std::uint32_t rays_per_batch) : rays_(rays), most_(rays_per_batch) {}

    [[nodiscard]] std::optional<LinkBatch> next_batch() override {
        while (fetched_ < batched_ + most_ && fetch()) {
        }
        const auto count = std::uint32_t(std::min<std::uint64_t>(most_, fetched_ - batched_));
        if (count == 0) return std::nullopt;
        batched_ += count;
        return LinkBatch{count, std::uint64_t{count} * ray_bytes, std::uint64_t{count} * hit_bytes};
    }
    [[nodiscard]] std::optional<SuppliedRay> next() override {
        if (held_.empty() && !fetch()) return std::nullopt;
        const SuppliedRay ray = held_.front();
        held_.pop_front();
        return ray;
    }
    [[nodiscard]] double share() const override { return rays_.share(); }

  private:
    bool fetch() {
        const std::optional<SuppliedRay> ray = rays_.next();
        if (ray) held_.push_back(*ray), ++fetched_;
        return ray.has_value();
    }

    RaySupply& rays_;
    std::uint32_t most_;
    std::deque<SuppliedRay> held_;  // fetched, not yet taken by the machine
    std::uint64_t fetched_ = 0, batched_ = 0;
};

}  // namespace rtu::sim
