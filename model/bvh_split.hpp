#pragma once

#include <cstddef>
#include <span>

#include "model/aabb.hpp"
#include "model/pair.hpp"
#include "model/vec3.hpp"

namespace rtu::model {

/// A box that holds every point of the pair's triangles that lies in `box` and, along `axis`, in [lo, hi];
/// empty when there is none. Each edge is clipped as it was given, never a part of it, so that errors do not
/// add up, and what is computed is rounded outwards: no point is lost, whatever the triangles. Within `box`.
[[nodiscard]] Aabb part_box(const TrianglePair& pair, std::span<const Vec3> positions, const Aabb& box,
                            std::size_t axis, float lo, float hi);

/// `box` as small as part_box() makes it along its three axes in turn: what a reference to the pair keeps of
/// its box once its splits are known. `box` itself where none of the pair lies in it.
[[nodiscard]] Aabb tightened_box(const TrianglePair& pair, std::span<const Vec3> positions, const Aabb& box);

}  // namespace rtu::model
