#pragma once

#include <algorithm>
#include <limits>

#include "model/vec3.hpp"

namespace rtu::model {

/// Axis-aligned bounding box [lo, hi], both ends inclusive. Default: empty (lo = +inf, hi = -inf).
struct Aabb {
    Vec3 lo{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
            std::numeric_limits<float>::infinity()};
    Vec3 hi{-lo.x, -lo.y, -lo.z};

    constexpr void extend(Vec3 p) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
    }
    constexpr void extend(const Aabb& box) {
        // Each corner against its own: an empty box must add nothing.
        lo = {std::min(lo.x, box.lo.x), std::min(lo.y, box.lo.y), std::min(lo.z, box.lo.z)};
        hi = {std::max(hi.x, box.hi.x), std::max(hi.y, box.hi.y), std::max(hi.z, box.hi.z)};
    }
    [[nodiscard]] constexpr bool contains(Vec3 p) const {
        return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
    }
    [[nodiscard]] constexpr bool contains(const Aabb& box) const {
        return contains(box.lo) && contains(box.hi);
    }
    /// Half of the surface area; scene units squared.
    [[nodiscard]] constexpr float half_area() const {
        const Vec3 d = hi - lo;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
    friend constexpr bool operator==(const Aabb&, const Aabb&) = default;
};

}  // namespace rtu::model
