#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/camera.hpp"
#include "model/node_format.hpp"
#include "model/ray.hpp"
#include "traces/bytes.hpp"

namespace rtu::traces {

enum class TraceContent : std::uint8_t { Rays = 1, Visits = 2 };

/// The memory image whose nodes and leaves a traversal trace names.
struct ImageFacts {
    std::uint64_t fingerprint = 0;  ///< model::fingerprint() of the image
    std::uint64_t size_bytes = 0;
    std::uint64_t node_count = 0;
    std::uint32_t width = 0;  ///< 2, 4, 6 or 8
    model::NodeFormat node_format = model::NodeFormat::Full;
    friend bool operator==(const ImageFacts&, const ImageFacts&) = default;
};

/// The picture that the rays were made for.
struct PictureFacts {
    model::Resolution resolution;
    model::Camera camera;
    std::string camera_source;  ///< as in reports
    std::uint64_t seed = 0;
};

/// Where a trace comes from.
struct TraceHeader {
    TraceContent content = TraceContent::Rays;
    std::optional<std::uint64_t> scene_hash;  ///< model::fingerprint() of the mesh; none: tied to no scene
    std::string scene_name;
    std::string generator;  ///< the program that made it, with its version
    std::optional<PictureFacts> picture;
    std::string image_text;           ///< how pairs and tree were made, in words; visits only
    std::optional<ImageFacts> image;  ///< visits only, and always there
};

/// A header of rays that only says who made them.
[[nodiscard]] TraceHeader header_of_rays(std::string generator);

/// A workload, and how many rays of it a trace has.
struct WorkloadCount {
    std::string name;
    model::RayKind kind = model::RayKind::ClosestHit;
    std::uint64_t ray_count = 0;
    friend bool operator==(const WorkloadCount&, const WorkloadCount&) = default;
};

/// What the block at the end of a trace says. It repeats the header, in case that is damaged.
struct TraceEnd {
    TraceHeader header;
    std::uint64_t block_count = 0;  ///< with the header and this one
    std::vector<WorkloadCount> workloads;
};

[[nodiscard]] std::string encode(const TraceHeader& header);
[[nodiscard]] std::string encode(const TraceEnd& end);
/// Both throw Error for what encode() cannot have written.
[[nodiscard]] TraceHeader decode_header(std::string_view payload);
[[nodiscard]] TraceEnd decode_end(std::string_view payload);

/// Counts the rays of workloads that come one after another, chunk by chunk.
class WorkloadTally {
  public:
    /// Throws Error when a workload comes again after another, changes its kind, or does not go on with the
    /// ray that is next.
    void add(const std::string& name, model::RayKind kind, std::uint64_t first_ray, std::uint64_t ray_count);
    [[nodiscard]] const std::vector<WorkloadCount>& counts() const { return counts_; }

  private:
    std::vector<WorkloadCount> counts_;
};

}  // namespace rtu::traces
