#pragma once

#include <optional>

#include "traces/ray_chunk.hpp"
#include "traces/trace_header.hpp"

namespace rtu::traces {

/// Rays from somewhere, chunk by chunk, workload after workload: a file, or a generator.
class RayReader {
  public:
    RayReader() = default;
    RayReader(const RayReader&) = delete;
    RayReader& operator=(const RayReader&) = delete;
    virtual ~RayReader() = default;

    /// Where they come from.
    [[nodiscard]] virtual const TraceHeader& header() const = 0;
    /// The next rays, all of one workload; maybe none of a workload that has none. Nothing after the last.
    /// Throws Error for input that cannot be read or used, naming file and place.
    [[nodiscard]] virtual std::optional<RayChunk> next() = 0;
    /// Share of the input that was read, 0 to 1.
    [[nodiscard]] virtual double share() const = 0;
};

/// Takes rays to a file, which is there after finish() only. Throws Error when it cannot be written, or when
/// its format cannot hold a ray.
class RayWriter {
  public:
    RayWriter() = default;
    RayWriter(const RayWriter&) = delete;
    RayWriter& operator=(const RayWriter&) = delete;
    virtual ~RayWriter() = default;

    virtual void add(const RayChunk& chunk) = 0;
    virtual void finish() = 0;
};

/// Rays of a chunk that a reader of another format than the trace's makes.
inline constexpr std::size_t import_chunk_rays = 1 << 14;

}  // namespace rtu::traces
