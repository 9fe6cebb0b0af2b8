#include "traces/ray_chunk.hpp"

#include <algorithm>
#include <array>

#include "model/error.hpp"
#include "traces/chunk_head.hpp"
#include "traces/columns.hpp"

namespace rtu::traces {
namespace {

using model::Ray;
using Member = float (*)(const Ray&);

// The columns of a chunk, in their order.
constexpr std::array<Member, 8> members{
    [](const Ray& r) { return r.origin.x; },    [](const Ray& r) { return r.origin.y; },
    [](const Ray& r) { return r.origin.z; },    [](const Ray& r) { return r.t_min; },
    [](const Ray& r) { return r.direction.x; }, [](const Ray& r) { return r.direction.y; },
    [](const Ray& r) { return r.direction.z; }, [](const Ray& r) { return r.t_max; }};

constexpr std::array<std::string_view, 3> id_kind_names{"none", "pixel", "parent"};

}  // namespace

bool is_workload_name(std::string_view name) {
    const auto is_good = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-' || c == '.';
    };
    return !name.empty() && name.size() <= name_bytes && std::all_of(name.begin(), name.end(), is_good);
}

std::string_view to_string(model::RayKind kind) { return kind == model::RayKind::AnyHit ? "any" : "closest"; }

model::RayKind parse_ray_kind(std::string_view text) {
    if (text == "closest") return model::RayKind::ClosestHit;
    if (text == "any") return model::RayKind::AnyHit;
    throw Error("ray kind: expected closest or any, got '{}'", text);
}

std::string_view to_string(IdKind kind) { return id_kind_names[std::size_t(kind)]; }

std::string encode(const RayChunk& chunk) {
    RTU_CHECK(chunk.rays.size() <= most_chunk_rays, "a chunk of {} rays", chunk.rays.size());
    RTU_CHECK(chunk.ids.size() == (chunk.id_kind == IdKind::None ? 0 : chunk.rays.size()),
              "{} ids of {} rays", chunk.ids.size(), chunk.rays.size());
    ByteWriter out;
    write_head(out, {chunk.workload, std::uint32_t(chunk.rays.size()), chunk.kind,
                     std::uint8_t(chunk.id_kind), chunk.first_ray});
    for (const Member member : members) append_column(out.bytes(), chunk.rays, member);
    append_column(out.bytes(), chunk.ids, [](std::uint32_t id) { return id; });
    return std::move(out.bytes());
}

RayChunk decode_ray_chunk(std::string_view payload) {
    ByteReader in(payload);
    const ChunkHead head = read_head(in);
    if (head.variant >= id_kind_names.size())
        throw Error("expected ids of kind 0 to 2, got {}", head.variant);
    RayChunk chunk{head.workload, head.kind, IdKind(head.variant), head.first_ray, {}, {}};
    const std::size_t count = head.ray_count;
    std::array<std::vector<float>, members.size()> columns;
    for (auto& column : columns) column = take_column<float>(in, count);
    if (chunk.id_kind != IdKind::None) chunk.ids = take_column<std::uint32_t>(in, count);
    in.end();
    chunk.rays.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& c = columns;
        chunk.rays.push_back({{c[0][i], c[1][i], c[2][i]}, c[3][i], {c[4][i], c[5][i], c[6][i]}, c[7][i]});
    }
    return chunk;
}

}  // namespace rtu::traces
