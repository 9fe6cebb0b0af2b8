#include "traces/visit_chunk.hpp"

#include <algorithm>

#include "traces/chunk_head.hpp"
#include "traces/columns.hpp"
#include "traces/visit_check.hpp"

namespace rtu::traces {
namespace {

// 0: pair tests without outcomes, which no machine with hit units can be timed by.
constexpr std::uint8_t variant_with_outcomes = 1;
// The same, and a column of the hits of quantised boxes only; for visits that have some.
constexpr std::uint8_t variant_with_extra_hits = 2;

// Two bits each.
std::uint8_t packed(const PairTest& test) {
    return std::uint8_t(test.triangle_tests | test.better_hits << 2 | test.exact_tests << 4 |
                        test.side_tests << 6);
}

PairTest unpacked(std::uint8_t byte) {
    const auto bits = [byte](int from) { return std::uint8_t(byte >> from & 3); };
    return {.triangle_tests = bits(0), .exact_tests = bits(4), .better_hits = bits(2), .side_tests = bits(6)};
}

std::vector<model::Hit> hits_of(const VisitChunk& chunk) {
    std::vector<model::Hit> hits;
    for (const WalkedRay& ray : chunk.rays) {
        if (ray.hit) hits.push_back(*ray.hit);
    }
    return hits;
}

template <class Items, class ValueOf>
void append_bytes(std::string& bytes, const Items& items, ValueOf value_of) {
    for (const auto& item : items) bytes.push_back(char(value_of(item)));
}

std::uint8_t byte_at(std::string_view bytes, std::size_t index) {
    return std::uint8_t(static_cast<unsigned char>(bytes[index]));
}

void take_rays(ByteReader& in, VisitChunk& chunk, std::uint32_t ray_count, std::uint32_t hit_count) {
    const auto visit_counts = take_column<std::uint32_t>(in, ray_count);
    const std::string_view has_hit = in.take(ray_count);
    const auto t = take_column<float>(in, hit_count), u = take_column<float>(in, hit_count),
               v = take_column<float>(in, hit_count);
    const auto primitive = take_column<std::uint32_t>(in, hit_count);
    std::size_t hit = 0;
    chunk.rays.resize(ray_count);
    for (std::size_t i = 0; i < ray_count; ++i) {
        chunk.rays[i].visit_count = visit_counts[i];
        const std::uint8_t flag = byte_at(has_hit, i);
        if (flag > 1 || (flag == 1 && hit == hit_count)) throw Error("expected {} hits", hit_count);
        if (flag == 0) continue;
        chunk.rays[i].hit = model::Hit{t[hit], u[hit], v[hit], primitive[hit]};
        ++hit;
    }
    if (hit != hit_count) throw Error("expected {} hits, got {}", hit_count, hit);
}

void take_visits(ByteReader& in, VisitChunk& chunk, std::uint32_t visit_count, std::uint32_t pair_count,
                 bool has_extra_hits) {
    const auto refs = take_column<model::NodeRef>(in, visit_count);
    const auto dropped = take_column<std::uint32_t>(in, visit_count);
    const std::string_view shapes = in.take(visit_count), pairs = in.take(pair_count);
    const std::string_view extra = in.take(has_extra_hits ? visit_count : 0);
    in.end();
    chunk.visits.reserve(visit_count);
    for (std::size_t i = 0; i < visit_count; ++i) {
        const std::uint8_t shape = byte_at(shapes, i);
        chunk.visits.push_back({refs[i], dropped[i], std::uint8_t(shape & 15), std::uint8_t(shape >> 4),
                                has_extra_hits ? byte_at(extra, i) : std::uint8_t(0)});
    }
    chunk.pair_tests.reserve(pair_count);
    for (std::size_t i = 0; i < pair_count; ++i) {
        chunk.pair_tests.push_back(unpacked(byte_at(pairs, i)));
    }
}

}  // namespace

std::string encode(const VisitChunk& chunk) {
    const std::vector<model::Hit> hits = hits_of(chunk);
    const bool has_extra_hits =
        std::ranges::any_of(chunk.visits, [](const Visit& visit) { return visit.extra_hits != 0; });
    ByteWriter out;
    write_head(out, {chunk.workload, std::uint32_t(chunk.rays.size()), chunk.kind,
                     has_extra_hits ? variant_with_extra_hits : variant_with_outcomes, chunk.first_ray});
    out.number(std::uint32_t(chunk.visits.size()));
    out.number(std::uint32_t(chunk.pair_tests.size()));
    out.number(std::uint32_t(hits.size()));
    out.number(std::uint32_t{0});
    std::string& bytes = out.bytes();
    append_column(bytes, chunk.rays, [](const WalkedRay& ray) { return ray.visit_count; });
    append_bytes(bytes, chunk.rays, [](const WalkedRay& ray) { return ray.hit ? 1 : 0; });
    append_column(bytes, hits, [](const model::Hit& hit) { return hit.t; });
    append_column(bytes, hits, [](const model::Hit& hit) { return hit.u; });
    append_column(bytes, hits, [](const model::Hit& hit) { return hit.v; });
    append_column(bytes, hits, [](const model::Hit& hit) { return hit.primitive_id; });
    append_column(bytes, chunk.visits, [](const Visit& visit) { return visit.ref; });
    append_column(bytes, chunk.visits, [](const Visit& visit) { return visit.dropped_entries; });
    append_bytes(bytes, chunk.visits, [](const Visit& visit) { return visit.tests | visit.pushes << 4; });
    append_bytes(bytes, chunk.pair_tests, packed);
    if (has_extra_hits) {
        append_bytes(bytes, chunk.visits, [](const Visit& visit) { return visit.extra_hits; });
    }
    return std::move(bytes);
}

VisitChunk decode_visit_chunk(std::string_view payload, const ImageFacts& image) {
    ByteReader in(payload);
    const ChunkHead head = read_head(in);
    if (head.variant != variant_with_outcomes && head.variant != variant_with_extra_hits) {
        throw Error("expected visits of variant {} or {}, got {}: record them again", variant_with_outcomes,
                    variant_with_extra_hits, head.variant);
    }
    VisitChunk chunk{head.workload, head.kind, head.first_ray, {}, {}, {}};
    const auto visit_count = in.number<std::uint32_t>();
    const auto pair_count = in.number<std::uint32_t>();
    const auto hit_count = in.number<std::uint32_t>();
    in.zeros(4);
    take_rays(in, chunk, head.ray_count, hit_count);
    take_visits(in, chunk, visit_count, pair_count, head.variant == variant_with_extra_hits);
    place_and_check(chunk, image);
    return chunk;
}

}  // namespace rtu::traces
