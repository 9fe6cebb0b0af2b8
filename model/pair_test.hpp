#pragma once

#include <array>
#include <cstdint>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/ray_setup.hpp"

namespace rtu::model {

/// The triangles of a pair that the ray pierces beyond its t_min, nearest or not.
struct PairHits {
    std::array<Hit, 2> hits{};
    std::array<bool, 2> is_pierced{};
    std::uint32_t exact_tests = 0;  ///< triangles that the first pass let through, 0 to 2
    std::uint32_t side_tests = 0;   ///< of those, the ones that it could not prove to be pierced
};

/// Tests a ray against the two triangles of a pair; both sides count. Two passes:
///
/// 1. binary32, after Woop, Benthin and Wald 2013 [WBW13]: each vertex is translated and sheared once, the
///    common edge is evaluated once, and a triangle is out when its edge functions differ in sign by more
///    than their rounding errors. Nothing is accepted here.
/// 2. What is left is decided exactly, on the numbers as they were given: a triangle is pierced when the ray
///    passes its three edges on the same side, and a ray exactly through an edge or a vertex belongs to one
///    triangle only (ExactTriangle::side()). So no closed mesh leaks or is hit twice, and a triangle that is
///    degenerate or seen edge-on is never pierced. t, u and v are their exact values, each rounded once.
///
/// A pair gives bit for bit what its triangles give one by one.
[[nodiscard]] PairHits test_pair(const LeafPair& pair, const RaySetup& ray);

}  // namespace rtu::model
