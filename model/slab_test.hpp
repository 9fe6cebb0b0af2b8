#pragma once

#include <array>
#include <cstdint>

#include "model/lanes.hpp"
#include "model/memory_image.hpp"
#include "model/quantised_node.hpp"
#include "model/ray_setup.hpp"

namespace rtu::model {

/// Where the ray enters each child's box, and which boxes it enters at all.
template <std::uint32_t Width>
struct SlabHits {
    std::array<float, Width> t_near;
    std::uint32_t mask = 0;  ///< bit i: the ray meets child i within [t_min, t_end]
};

/// What the slab test needs of a ray, in every lane.
template <std::uint32_t N>
struct SlabRay {
    explicit SlabRay(const RaySetup& ray) : t_min(all_lanes<N>(ray.t_min)), entry_side(ray.entry_side) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            origin_near[axis] = all_lanes<N>(ray.origin_near[axis]);
            origin_far[axis] = all_lanes<N>(ray.origin_far[axis]);
            inv_direction[axis] = all_lanes<N>(ray.inv_direction[axis]);
        }
    }
    std::array<Lanes<N>, 3> origin_near, origin_far, inv_direction;
    Lanes<N> t_min;
    std::array<std::uint32_t, 3> entry_side;
};

/// Lanes that one step of the slab test works on.
template <std::uint32_t Width>
inline constexpr std::uint32_t slab_lanes = Width == 2 ? 2 : 4;

/// Planes of N children from `first` on.
template <std::uint32_t N, std::uint32_t Width>
[[nodiscard]] inline Lanes<N> load_planes(const Node<Width>& node, std::uint32_t side, std::size_t axis,
                                          std::uint32_t first) {
    return load_lanes<N>(&node.planes[side][axis][first]);
}
template <std::uint32_t N, std::uint32_t Width>
[[nodiscard]] inline Lanes<N> load_planes(const QuantisedNode<Width>& node, std::uint32_t side,
                                          std::size_t axis, std::uint32_t first) {
    Lanes<N> steps;
    for (std::uint32_t i = 0; i < N; ++i) steps[i] = float(node.planes[side][axis][first + i]);
    return all_lanes<N>(node.origin[axis]) + steps * all_lanes<N>(node.step(axis));
}

/// Slab test of the children from `First` on, as many as there are lanes; see slab_test.
template <std::uint32_t First, class AnyNode>
inline void slab_test_from(const AnyNode& node, const SlabRay<slab_lanes<AnyNode::width>>& ray, float t_end,
                           SlabHits<AnyNode::width>& hits) {
    constexpr std::uint32_t n = slab_lanes<AnyNode::width>;
    Lanes<n> t_near = ray.t_min;
    Lanes<n> t_far = all_lanes<n>(t_end);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t entry = ray.entry_side[axis];
        const Lanes<n> near_plane = load_planes<n>(node, entry, axis, First);
        const Lanes<n> far_plane = load_planes<n>(node, 1 - entry, axis, First);
        const Lanes<n> near = (near_plane - ray.origin_near[axis]) * ray.inv_direction[axis];
        const Lanes<n> far = (far_plane - ray.origin_far[axis]) * ray.inv_direction[axis];
        // Written so that a NaN leaves t_near and t_far as they are.
        t_near = near > t_near ? near : t_near;
        t_far = far < t_far ? far : t_far;
    }
    store_lanes<n>(t_near, &hits.t_near[First]);
    hits.mask |= mask_of<n>(t_near <= t_far) << First;
}

/// Slab test of all children of a node, Node or QuantisedNode, against one ray. Conservative: it keeps every
/// box that holds a triangle which the pair test accepts with t <= t_end, and its t_near is not above that t.
/// An axis that gives NaN (moved origin on a plane of a slab that the ray runs along) culls nothing. Boxes
/// that enclose others bit for bit are met where those are, at a t_near that is not greater: all its steps
/// are monotonic.
template <class AnyNode>
[[nodiscard]] inline SlabHits<AnyNode::width> slab_test(const AnyNode& node,
                                                        const SlabRay<slab_lanes<AnyNode::width>>& ray,
                                                        float t_end) {
    constexpr std::uint32_t width = AnyNode::width;
    SlabHits<width> hits;
    slab_test_from<0>(node, ray, t_end, hits);
    // Of six children, the second step does two once more.
    if constexpr (width > 4) slab_test_from<width - 4>(node, ray, t_end, hits);
    hits.mask &= (1U << node.child_count) - 1U;
    return hits;
}

}  // namespace rtu::model
