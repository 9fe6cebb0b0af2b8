#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "traces/trace_header.hpp"

namespace rtu::traces {

/// One node or leaf that a ray visited.
struct Visit {
    model::NodeRef ref;
    /// Stack entries dropped after it, because they start behind the closest hit.
    std::uint32_t dropped_entries = 0;
    std::uint8_t tests = 0;       ///< inner node: boxes tested, 1 to 8; leaf: pairs tested, 1 to 8
    std::uint8_t pushes = 0;      ///< inner node: children that went onto the stack, 0 to 8
    std::uint8_t extra_hits = 0;  ///< of those, 0 to pushes, as model::NodeVisit says
};

/// What one pair test took, as model::PairVisit says.
struct PairTest {
    std::uint8_t triangle_tests = 0;  ///< 1 or 2
    std::uint8_t exact_tests = 0;     ///< 0 to triangle_tests
    std::uint8_t better_hits = 0;     ///< 0 to exact_tests
    std::uint8_t side_tests = 0;      ///< 0 to exact_tests
};

/// Where a ray's steps lie in its chunk, and what it hit.
struct WalkedRay {
    std::uint32_t first_visit = 0;
    std::uint32_t visit_count = 0;  ///< 0: the ray was not traversed
    std::uint32_t first_pair_test = 0;
    std::optional<model::Hit> hit;
};

/// The traversals of some rays of one workload, in the order of the rays.
struct VisitChunk {
    std::string workload = "rays";
    model::RayKind kind = model::RayKind::ClosestHit;
    std::uint64_t first_ray = 0;
    std::vector<WalkedRay> rays;
    std::vector<Visit> visits;
    std::vector<PairTest> pair_tests;  ///< of all leaf visits, in order
};

/// The payload of a block of visits.
[[nodiscard]] std::string encode(const VisitChunk& chunk);

/// Reads it back. Throws Error unless every ray's steps are a possible traversal: it starts at the root, what
/// it visits lies in the image, and what it drops and visits is what it pushed.
[[nodiscard]] VisitChunk decode_visit_chunk(std::string_view payload, const ImageFacts& image);

}  // namespace rtu::traces
