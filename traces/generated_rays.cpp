#include "traces/generated_rays.hpp"

#include <algorithm>
#include <utility>

namespace rtu::traces {
namespace {

// Enough to keep all cores busy, and a few megabytes.
constexpr std::uint32_t pixels_of_chunk = 1 << 16;

}  // namespace

GeneratedRays::GeneratedRays(std::vector<model::WorkloadKind> workloads, model::WorkloadSetting setting,
                             TraceHeader header)
    : workloads_(std::move(workloads)), setting_(setting), header_(std::move(header)) {}

double GeneratedRays::share() const {
    const double pixels = double(setting_.resolution.width) * setting_.resolution.height;
    return (double(workload_) + double(next_pixel_) / pixels) / double(workloads_.size());
}

std::optional<RayChunk> GeneratedRays::next() {
    const std::uint32_t pixel_count = setting_.resolution.width * setting_.resolution.height;
    if (next_pixel_ == pixel_count) {
        next_pixel_ = 0;
        ray_count_ = 0;
        ++workload_;
    }
    if (workload_ == workloads_.size()) return std::nullopt;
    const std::uint32_t end = next_pixel_ + std::min(pixels_of_chunk, pixel_count - next_pixel_);
    model::Workload part = model::make_workload(workloads_[workload_], setting_, next_pixel_, end);
    next_pixel_ = end;
    RayChunk chunk{part.name,  part.ray_kind,        IdKind::Pixel,
                   ray_count_, std::move(part.rays), std::move(part.pixels)};
    ray_count_ += chunk.rays.size();
    return chunk;
}

}  // namespace rtu::traces
