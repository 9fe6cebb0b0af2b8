#include "model/bvh_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rtu::model {

namespace {

// Adds where the edge a-b meets the plane; the ends lie on different sides of it.
void extend_by_crossing(Aabb& box, Vec3 a, Vec3 b, std::size_t axis, float plane) {
    const double share = (double(plane) - a[axis]) / (double(b[axis]) - a[axis]);
    Vec3 lo, hi;
    for (std::size_t i = 0; i < 3; ++i) {
        const double from = a[i], to = b[i];
        // Twice the rounding to binary32 at the end, subnormal or not: the six of binary64 are far less.
        const double error = 0x1p-23 * std::max(std::abs(from), std::abs(to)) + 0x1p-149;
        const double point = from + share * (to - from);
        lo[i] = float(std::max(point - error, std::min(from, to)));
        hi[i] = float(std::min(point + error, std::max(from, to)));
    }
    lo[axis] = hi[axis] = plane;
    box.extend({lo, hi});
}

Aabb clipped_triangle_box(const std::array<Vec3, 3>& corners, std::size_t axis, float lo, float hi) {
    Aabb box;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = corners[i], b = corners[(i + 1) % 3];
        if (lo <= a[axis] && a[axis] <= hi) box.extend(a);
        for (const float plane : {lo, hi}) {
            const bool crosses = (a[axis] < plane && plane < b[axis]) || (b[axis] < plane && plane < a[axis]);
            if (crosses) extend_by_crossing(box, a, b, axis, plane);
        }
    }
    return box;
}

Aabb intersection(const Aabb& a, const Aabb& b) {
    const Aabb both{{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
                    {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
    const bool is_empty = both.lo.x > both.hi.x || both.lo.y > both.hi.y || both.lo.z > both.hi.z;
    return is_empty ? Aabb{} : both;
}

}  // namespace

Aabb part_box(const TrianglePair& pair, std::span<const Vec3> positions, const Aabb& box, std::size_t axis,
              float lo, float hi) {
    std::array<Vec3, 4> v;
    for (std::size_t i = 0; i < 4; ++i) v[i] = positions[pair.vertices[i]];
    Aabb part = intersection(clipped_triangle_box({v[0], v[1], v[2]}, axis, lo, hi), box);
    if (pair.has_second) {
        part.extend(intersection(clipped_triangle_box({v[0], v[2], v[3]}, axis, lo, hi), box));
    }
    return part;
}

Aabb tightened_box(const TrianglePair& pair, std::span<const Vec3> positions, const Aabb& box) {
    Aabb tight = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Aabb part = part_box(pair, positions, tight, axis, tight.lo[axis], tight.hi[axis]);
        if (part == Aabb{}) return box;
        tight = part;
    }
    return tight;
}

}  // namespace rtu::model
