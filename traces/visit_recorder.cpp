#include "traces/visit_recorder.hpp"

#include <algorithm>
#include <iterator>

#include "model/fingerprint.hpp"
#include "model/parallel.hpp"

namespace rtu::traces {
namespace {

// Enough for zstd to find what repeats; with the visits of an average ray, about a megabyte.
constexpr std::size_t rays_of_chunk = 1024;
// Rays that visit thousands of nodes each fill a chunk before that.
constexpr std::size_t visits_of_chunk = 1 << 20;

Visit visit_leaf(VisitChunk& chunk, const model::MemoryImage& image, model::Traversal& traversal) {
    Visit visit{traversal.current.ref, 0, 0, 0, 0};
    while (visit.tests < visit.ref.pair_count() && !model::is_satisfied(traversal)) {
        const model::PairVisit pair = model::visit_pair(traversal, image, visit.tests);
        chunk.pair_tests.push_back({std::uint8_t(pair.triangle_tests), std::uint8_t(pair.exact_tests),
                                    std::uint8_t(pair.better_hits), std::uint8_t(pair.side_tests)});
        ++visit.tests;
    }
    return visit;
}

Visit visit_inner(const model::MemoryImage& image, model::Traversal& traversal) {
    Visit visit{traversal.current.ref, 0, 0, 0, 0};
    const model::NodeVisit node = model::visit_node(traversal, image);
    visit.tests = std::uint8_t(node.box_tests);
    visit.pushes = std::uint8_t(node.box_hits);
    visit.extra_hits = std::uint8_t(node.extra_hits);
    return visit;
}

std::vector<VisitChunk> record_part(const RayChunk& rays, std::size_t begin, std::size_t end,
                                    const model::MemoryImage& image) {
    std::vector<VisitChunk> chunks;
    model::Traversal scratch;
    const auto add_chunk = [&](std::size_t first) {
        chunks.push_back({rays.workload, rays.kind, rays.first_ray + first, {}, {}, {}});
    };
    add_chunk(begin);
    for (std::size_t i = begin; i < end; ++i) {
        if (chunks.back().visits.size() >= visits_of_chunk) add_chunk(i);
        record_visits(chunks.back(), image, rays.rays[i], scratch);
    }
    return chunks;
}

}  // namespace

ImageFacts image_facts(const model::MemoryImage& image) {
    return {model::fingerprint(image), image.size_bytes(), image.node_count, image.width, image.format};
}

void record_visits(VisitChunk& chunk, const model::MemoryImage& image, const model::Ray& ray,
                   model::Traversal& scratch) {
    WalkedRay walked{std::uint32_t(chunk.visits.size()), 0, std::uint32_t(chunk.pair_tests.size()), {}};
    bool is_under_way = model::start(scratch, image, ray, chunk.kind);
    while (is_under_way) {
        Visit visit =
            scratch.current.ref.is_leaf() ? visit_leaf(chunk, image, scratch) : visit_inner(image, scratch);
        if (model::is_satisfied(scratch)) {
            is_under_way = false;
        } else {
            const std::size_t before = scratch.stack.size();
            is_under_way = model::pop(scratch);
            visit.dropped_entries = std::uint32_t(before - scratch.stack.size() - (is_under_way ? 1 : 0));
        }
        chunk.visits.push_back(visit);
    }
    walked.visit_count = std::uint32_t(chunk.visits.size()) - walked.first_visit;
    if (scratch.closest.is_found) walked.hit = scratch.closest.hit;
    chunk.rays.push_back(walked);
}

std::vector<VisitChunk> record_visits(const RayChunk& rays, const model::MemoryImage& image) {
    const std::size_t parts =
        std::max<std::size_t>(1, (rays.rays.size() + rays_of_chunk - 1) / rays_of_chunk);
    std::vector<std::vector<VisitChunk>> chunks(parts);
    model::for_each_range<std::size_t>(parts, 1, [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::size_t begin = i * rays_of_chunk;
            chunks[i] = record_part(rays, begin, std::min(begin + rays_of_chunk, rays.rays.size()), image);
        }
    });
    std::vector<VisitChunk> result;
    for (auto& part : chunks) std::move(part.begin(), part.end(), std::back_inserter(result));
    return result;
}

}  // namespace rtu::traces
