#pragma once

#include <cstdint>
#include <vector>

#include "model/traversal.hpp"

namespace rtu::model {

/// What the traversal of one ray did, and where it went.
struct TraversalLog {
    std::vector<NodeRef> visits;  ///< in order, inner nodes and leaves
    std::uint32_t node_visits = 0, box_tests = 0, leaf_visits = 0, pair_tests = 0;
    std::uint32_t survivor_pairs = 0;  ///< pairs with a triangle that the first pass lets through
    PairVisit pairs;                   ///< the sums over all pair tests
};

/// The reference traversal with a log, which is emptied first; a ray that cannot hit anything leaves it
/// empty.
void trace(TraversalStack& stack, const MemoryImage& image, const Ray& ray, RayKind kind, TraversalLog& log);

}  // namespace rtu::model
