#pragma once

#include <array>
#include <cstdint>

#include "model/lanes.hpp"
#include "model/memory_image.hpp"
#include "model/ray_setup.hpp"

namespace rtu::model {

/// Where the ray enters each child's box, and which boxes it enters at all.
template <std::uint32_t Width>
struct SlabHits {
    std::array<float, Width> t_near;
    std::uint32_t mask = 0;  ///< bit i: the ray meets child i within [t_min, t_end]
};

/// Slab test of children [First, First + N) of a node; see slab_test.
template <std::uint32_t First, std::uint32_t N, std::uint32_t Width>
inline void slab_test_lanes(const Node<Width>& node, const RaySetup& ray, float t_end,
                            SlabHits<Width>& hits) {
    Lanes<N> t_near = Lanes<N>{} + ray.t_min;
    Lanes<N> t_far = Lanes<N>{} + t_end;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Lanes<N> lo = load_lanes<N>(&node.lo[axis][First]);
        const Lanes<N> hi = load_lanes<N>(&node.hi[axis][First]);
        const Lanes<N> near =
            ((ray.is_negative[axis] ? hi : lo) - ray.origin_near[axis]) * ray.inv_direction[axis];
        const Lanes<N> far =
            ((ray.is_negative[axis] ? lo : hi) - ray.origin_far[axis]) * ray.inv_direction[axis];
        // Written so that a NaN leaves t_near and t_far as they are.
        t_near = near > t_near ? near : t_near;
        t_far = far < t_far ? far : t_far;
    }
    store_lanes<N>(t_near, &hits.t_near[First]);
    const auto is_hit = t_near <= t_far;
    for (std::uint32_t i = 0; i < N; ++i) hits.mask |= std::uint32_t(is_hit[i] & 1) << (First + i);
}

/// Slab test of all children of a node against one ray. Conservative: it keeps every box that holds a
/// triangle which the pair test accepts with t <= t_end. An axis that gives NaN (origin on a plane of a slab
/// that the ray runs along) culls nothing. t_near does not decrease from a box to any box inside it: every
/// operation on the way is monotone.
template <std::uint32_t Width>
[[nodiscard]] inline SlabHits<Width> slab_test(const Node<Width>& node, const RaySetup& ray, float t_end) {
    SlabHits<Width> hits;
    if constexpr (Width == 2) {
        slab_test_lanes<0, 2>(node, ray, t_end, hits);
    } else {
        slab_test_lanes<0, 4>(node, ray, t_end, hits);
        if constexpr (Width == 6) slab_test_lanes<4, 2>(node, ray, t_end, hits);
        if constexpr (Width == 8) slab_test_lanes<4, 4>(node, ray, t_end, hits);
    }
    hits.mask &= (1U << node.child_count) - 1U;
    return hits;
}

}  // namespace rtu::model
