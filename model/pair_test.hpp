#pragma once

#include <array>
#include <cstdint>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/ray_setup.hpp"

namespace rtu::model {

/// The triangles of a pair that the ray's line pierces, nearest or not: t is not compared with anything here.
struct PairHits {
    std::array<Hit, 2> hits{};
    std::array<bool, 2> is_pierced{};
};

/// Tests a ray against the two triangles of a pair; both sides count. Watertight after Woop, Benthin and Wald
/// 2013 [WBW13], with our tie rule: each vertex is translated and sheared once, the common edge is evaluated
/// once, the sign of every edge function is exact and its magnitude rounded once, and a ray that runs exactly
/// through an edge or a vertex belongs to one triangle only (the edge functions are taken at the ray moved by
/// (e, e^2), e infinitely small, in the sheared plane, which is a top-left rule). A pair gives bit for bit
/// what its triangles give one by one. A triangle whose edge functions sum to zero, or that is marked
/// degenerate, is not pierced. `t_near` is where the ray enters the leaf's box: rounding may put a grazing
/// hit in front of it, and t is then raised to it, so that the hit does not depend on the order in which
/// boxes are visited.
[[nodiscard]] PairHits test_pair(const LeafPair& pair, const RaySetup& ray, float t_near);

}  // namespace rtu::model
