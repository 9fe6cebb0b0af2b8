#include "study/workload_stream.hpp"

#include <utility>

#include "study/cpu_time.hpp"

namespace rtu::study {

ChunkSource chunks_of(std::shared_ptr<traces::RayReader> rays) {
    const auto next = [rays]() -> std::optional<WorkloadChunk> {
        std::optional<traces::RayChunk> chunk = rays->next();
        if (!chunk) return std::nullopt;
        return WorkloadChunk{std::move(chunk->workload), chunk->kind, std::move(chunk->rays), nullptr};
    };
    return {next, [rays] { return rays->share(); }};
}

ChunkSource chunks_of(std::shared_ptr<traces::TraceReader> visits) {
    const auto next = [visits]() -> std::optional<WorkloadChunk> {
        std::optional<traces::VisitChunk> chunk = visits->next_visits();
        if (!chunk) return std::nullopt;
        const auto shared = std::make_shared<const traces::VisitChunk>(std::move(*chunk));
        return WorkloadChunk{shared->workload, shared->kind, {}, shared};
    };
    return {next, [visits] { return visits->share(); }};
}

WorkloadStream::WorkloadStream(ChunkSource source) : source_(std::move(source)) { take_chunk(); }

void WorkloadStream::take_chunk() {
    const double start = study::cpu_seconds();
    following_ = source_.next();
    cpu_seconds_ += study::cpu_seconds() - start;
    share_before_ = share_after_;
    share_after_ = source_.share();
}

bool WorkloadStream::next_workload() {
    chunk_ = std::exchange(following_, std::nullopt);
    next_ray_ = 0;
    return chunk_.has_value();
}

std::optional<sim::SuppliedRay> WorkloadStream::next() {
    while (next_ray_ == chunk_->size()) {
        if (!following_) take_chunk();
        if (!following_ || following_->workload != chunk_->workload) return std::nullopt;
        static_cast<void>(next_workload());
    }
    const std::size_t index = next_ray_++;
    if (chunk_->visits) return sim::SuppliedRay{{}, {chunk_->visits, std::uint32_t(index)}};
    return sim::SuppliedRay{chunk_->rays[index], {}};
}

double WorkloadStream::share() const {
    const std::size_t size = chunk_ ? chunk_->size() : 0;
    const double part = size == 0 ? 0.0 : double(next_ray_) / double(size);
    return share_before_ + (share_after_ - share_before_) * part;
}

}  // namespace rtu::study
