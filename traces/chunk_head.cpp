#include "traces/chunk_head.hpp"

#include "traces/ray_chunk.hpp"

namespace rtu::traces {

void write_head(ByteWriter& out, const ChunkHead& head) {
    RTU_CHECK(is_workload_name(head.workload), "a workload named '{}'", head.workload);
    out.padded(head.workload, name_bytes);
    out.number(head.ray_count);
    out.number(std::uint8_t(head.kind));
    out.number(head.variant);
    out.number(std::uint16_t{0});
    out.number(head.first_ray);
}

ChunkHead read_head(ByteReader& in) {
    ChunkHead head;
    head.workload = in.padded(name_bytes);
    if (!is_workload_name(head.workload)) throw Error("expected the name of a workload");
    head.ray_count = in.number<std::uint32_t>();
    if (head.ray_count > most_chunk_rays) {
        throw Error("expected at most {} rays in a chunk, got {}", most_chunk_rays, head.ray_count);
    }
    const auto kind = in.number<std::uint8_t>();
    if (kind > 1) throw Error("expected ray kind 0 (closest) or 1 (any), got {}", kind);
    head.kind = model::RayKind(kind);
    head.variant = in.number<std::uint8_t>();
    in.zeros(2);
    head.first_ray = in.number<std::uint64_t>();
    return head;
}

}  // namespace rtu::traces
