#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "model/ray.hpp"
#include "traces/recorded_walk.hpp"

namespace rtu::sim {

/// A ray for the machine: to be traversed, or traversed already.
struct SuppliedRay {
    model::Ray ray;                ///< of no meaning for a recorded one
    traces::RecordedRay recorded;  ///< without a chunk: the machine asks model/ for every step
};

/// The rays of one workload one after another, so that they need not fit into memory.
class RaySupply {
  public:
    RaySupply() = default;
    RaySupply(const RaySupply&) = delete;
    RaySupply& operator=(const RaySupply&) = delete;
    virtual ~RaySupply() = default;

    /// The next ray; nothing after the last. What it throws ends the simulation and comes out of it.
    [[nodiscard]] virtual std::optional<SuppliedRay> next() = 0;
    /// Share of the rays that were supplied, 0 to 1, as far as is known.
    [[nodiscard]] virtual double share() const = 0;
};

/// Rays that are in memory.
class SpanSupply final : public RaySupply {
  public:
    explicit SpanSupply(std::span<const model::Ray> rays) : rays_(rays) {}
    [[nodiscard]] std::optional<SuppliedRay> next() override {
        if (next_ == rays_.size()) return std::nullopt;
        return SuppliedRay{rays_[next_++], {}};
    }
    [[nodiscard]] double share() const override {
        return rays_.empty() ? 1.0 : double(next_) / double(rays_.size());
    }

  private:
    std::span<const model::Ray> rays_;
    std::size_t next_ = 0;
};

}  // namespace rtu::sim
