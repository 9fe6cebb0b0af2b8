#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/ray_supply.hpp"
#include "traces/ray_stream.hpp"
#include "traces/trace_reader.hpp"
#include "traces/visit_chunk.hpp"

namespace rtu::study {

/// Rays of one workload, to be traversed or with their recorded traversals.
struct WorkloadChunk {
    std::string workload;
    model::RayKind kind = model::RayKind::ClosestHit;
    std::vector<model::Ray> rays;                      ///< empty when there are visits
    std::shared_ptr<const traces::VisitChunk> visits;  ///< none: rays to be traversed
    [[nodiscard]] std::size_t size() const { return visits ? visits->rays.size() : rays.size(); }
};

/// Where chunks come from: a generator, a file of rays or a traversal trace.
struct ChunkSource {
    std::function<std::optional<WorkloadChunk>()> next;  ///< nothing after the last
    std::function<double()> share;                       ///< of the input that was read, 0 to 1
};

[[nodiscard]] ChunkSource chunks_of(std::shared_ptr<traces::RayReader> rays);
[[nodiscard]] ChunkSource chunks_of(std::shared_ptr<traces::TraceReader> visits);

/// The workloads of a source one after another, each as a supply for the machine.
class WorkloadStream final : public sim::RaySupply {
  public:
    explicit WorkloadStream(ChunkSource source);

    /// Goes on to the next workload, once next() gave nothing more of the last; false: there is none.
    [[nodiscard]] bool next_workload();
    [[nodiscard]] const std::string& name() const { return chunk_->workload; }
    [[nodiscard]] model::RayKind kind() const { return chunk_->kind; }

    [[nodiscard]] std::optional<sim::SuppliedRay> next() override;
    /// Over all workloads.
    [[nodiscard]] double share() const override;
    /// Host CPU time that making or reading the rays has taken so far.
    [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }

  private:
    void take_chunk();

    ChunkSource source_;
    std::optional<WorkloadChunk> chunk_;      // of the workload under way
    std::optional<WorkloadChunk> following_;  // of the workload behind it
    std::size_t next_ray_ = 0;                // of chunk_
    double share_before_ = 0, share_after_ = 0;
    double cpu_seconds_ = 0;
};

}  // namespace rtu::study
