#pragma once

#include <cstdint>
#include <string>

#include "model/ray.hpp"
#include "traces/bytes.hpp"

namespace rtu::traces {

/// The first 48 bytes of every chunk of rays or visits.
struct ChunkHead {
    std::string workload;
    std::uint32_t ray_count = 0;
    model::RayKind kind = model::RayKind::ClosestHit;
    std::uint8_t variant = 0;  ///< rays: IdKind; visits: 1 or 2
    std::uint64_t first_ray = 0;
};

void write_head(ByteWriter& out, const ChunkHead& head);
/// Throws Error for a name, count or kind that no chunk can have.
[[nodiscard]] ChunkHead read_head(ByteReader& in);

}  // namespace rtu::traces
