#pragma once

#include <cstdint>
#include <vector>

#include "model/workload.hpp"
#include "traces/ray_stream.hpp"

namespace rtu::traces {

/// The rays that a run makes for its workloads, a part of the picture at a time.
class GeneratedRays final : public RayReader {
  public:
    /// The mesh, the image and the camera behind `setting` must outlive it. `header` is handed through.
    GeneratedRays(std::vector<model::WorkloadKind> workloads, model::WorkloadSetting setting,
                  TraceHeader header);

    [[nodiscard]] const TraceHeader& header() const override { return header_; }
    [[nodiscard]] std::optional<RayChunk> next() override;
    [[nodiscard]] double share() const override;

  private:
    std::vector<model::WorkloadKind> workloads_;
    model::WorkloadSetting setting_;
    TraceHeader header_;
    std::size_t workload_ = 0;
    std::uint32_t next_pixel_ = 0;
    std::uint64_t ray_count_ = 0;  // of the workload under way
};

}  // namespace rtu::traces
