#include "model/memory_image.hpp"

#include "model/exact_predicates.hpp"

namespace rtu::model {

namespace {

std::uint32_t order_bits(CornerOrder order) {
    return std::uint32_t(order.rotation) | (order.is_reversed ? 4U : 0U);
}

}  // namespace

LeafPair make_leaf_pair(const TrianglePair& pair, std::span<const Vec3> positions) {
    LeafPair leaf{};
    for (std::size_t i = 0; i < 4; ++i) leaf.vertices[i] = positions[pair.vertices[i]];
    const auto& [v0, v1, v2, v3] = leaf.vertices;
    leaf.primitive_ids = pair.primitive_ids;
    leaf.flags = (pair.has_second ? 1U : 0U) | order_bits(pair.corner_order[0]) << 1 |
                 order_bits(pair.corner_order[1]) << 4;
    if (is_collinear(v0, v1, v2)) leaf.flags |= 1U << 8;
    if (pair.has_second && is_collinear(v0, v2, v3)) leaf.flags |= 1U << 9;
    return leaf;
}

}  // namespace rtu::model
