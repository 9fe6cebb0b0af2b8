#include "traces/visit_check.hpp"

#include "model/error.hpp"

namespace rtu::traces {
namespace {

using model::MemoryImage;
using model::NodeRef;

// What is wrong with one visit by itself, if anything.
const char* fault_of(const Visit& visit, const ImageFacts& image) {
    const std::uint64_t node_bytes = MemoryImage::node_bytes(image.width, image.node_format);
    const std::uint64_t nodes_end = image.node_count * node_bytes, address = visit.ref.address();
    if (visit.ref.is_leaf()) {
        const std::uint64_t end = address + visit.ref.pair_count() * std::uint64_t{model::image_block_bytes};
        if (address < nodes_end || end > image.size_bytes) return "a leaf outside of the image's leaves";
        if (visit.tests < 1 || visit.tests > visit.ref.pair_count()) return "a count of pair tests";
        if (visit.pushes != 0 || visit.extra_hits != 0) return "pushes after a leaf";
        return nullptr;
    }
    if (address >= nodes_end || address % node_bytes != 0 || visit.ref != NodeRef::inner(address)) {
        return "a node outside of the image's nodes";
    }
    const std::uint32_t most_extra = image.node_format == model::NodeFormat::Full ? 0 : visit.pushes;
    if (visit.tests < 1 || visit.tests > image.width || visit.pushes > visit.tests ||
        visit.extra_hits > most_extra) {
        return "a count of boxes";
    }
    return nullptr;
}

class RayCheck {
  public:
    RayCheck(const VisitChunk& chunk, const ImageFacts& image, std::size_t ray)
        : chunk_(chunk), image_(image), ray_(chunk.rays[ray]), name_(chunk.first_ray + ray) {}

    // Walks the ray's visits, the first of which must be the root; returns the pair tests they take.
    std::uint32_t run() {
        for (std::uint32_t i = 0; i < ray_.visit_count; ++i) {
            const Visit& visit = chunk_.visits[ray_.first_visit + i];
            if (const char* fault = fault_of(visit, image_)) fail(fault);
            if (i == 0 && visit.ref != NodeRef::inner(0)) fail("another start than the root");
            step(visit, i + 1 == ray_.visit_count);
        }
        if (ray_.visit_count == 0 && ray_.hit) fail("a hit without a visit");
        return pair_tests_;
    }

  private:
    void step(const Visit& visit, bool is_last) {
        if (visit.ref.is_leaf()) pair_tests_ += visit.tests;
        stack_ += visit.pushes;
        // An any-hit ray ends at its first hit, within a leaf and with entries on its stack.
        const bool is_satisfied = is_last && chunk_.kind == model::RayKind::AnyHit && ray_.hit;
        if (is_satisfied && visit.ref.is_leaf()) {
            if (visit.dropped_entries != 0) fail("entries dropped after the end");
            return;
        }
        if (is_satisfied) fail("a hit in an inner node");
        if (visit.ref.is_leaf() && visit.tests != visit.ref.pair_count()) fail("a leaf tested in part");
        if (is_last ? visit.dropped_entries != stack_ : visit.dropped_entries >= stack_) {
            fail("visits that were not pushed");
        }
        stack_ -= visit.dropped_entries + (is_last ? 0 : 1);
    }
    [[noreturn]] void fail(const char* what) const {
        throw Error("ray {} of '{}': impossible traversal: {}", name_, chunk_.workload, what);
    }

    const VisitChunk& chunk_;
    const ImageFacts& image_;
    const WalkedRay& ray_;
    std::uint64_t name_;
    std::uint64_t stack_ = 0;
    std::uint32_t pair_tests_ = 0;
};

}  // namespace

void place_and_check(VisitChunk& chunk, const ImageFacts& image) {
    std::uint64_t visit = 0, pair = 0;
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        WalkedRay& ray = chunk.rays[i];
        ray.first_visit = std::uint32_t(visit);
        ray.first_pair_test = std::uint32_t(pair);
        visit += ray.visit_count;
        if (visit > chunk.visits.size()) throw Error("expected {} visits, got more", chunk.visits.size());
        pair += RayCheck(chunk, image, i).run();
    }
    if (visit != chunk.visits.size() || pair != chunk.pair_tests.size()) {
        throw Error("expected {} visits and {} pair tests, got {} and {}", chunk.visits.size(),
                    chunk.pair_tests.size(), visit, pair);
    }
    for (const PairTest test : chunk.pair_tests) {
        if (test.triangle_tests < 1 || test.triangle_tests > 2 || test.exact_tests > test.triangle_tests) {
            throw Error("expected a pair test of 1 or 2 triangles");
        }
        if (test.better_hits > test.exact_tests || test.side_tests > test.exact_tests) {
            throw Error("expected no more hits and open sides than exact tests");
        }
    }
}

}  // namespace rtu::traces
