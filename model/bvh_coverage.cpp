#include "model/bvh_coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rtu::model {

namespace {

constexpr int grid_steps = 16;

using Point = std::array<double, 3>;

bool is_inside(const Aabb& box, const Point& p, const Point& slack) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (p[i] < box.lo[i] - slack[i] || p[i] > box.hi[i] + slack[i]) return false;
    }
    return true;
}

bool has_all_corners(const std::array<Vec3, 3>& corners, std::span<const Aabb> boxes) {
    return std::ranges::all_of(corners, [&](Vec3 corner) {
        return std::ranges::any_of(boxes, [&](const Aabb& box) { return box.contains(corner); });
    });
}

bool is_triangle_covered(const std::array<Vec3, 3>& corners, std::span<const Aabb> boxes) {
    if (!has_all_corners(corners, boxes)) return false;
    Point slack;  // far above what a grid point's few roundings can take it off the triangle
    for (std::size_t i = 0; i < 3; ++i) {
        slack[i] = 0x1p-40 * std::max({std::abs(double(corners[0][i])), std::abs(double(corners[1][i])),
                                       std::abs(double(corners[2][i]))});
    }
    for (int u = 0; u <= grid_steps; ++u) {
        for (int v = 0; u + v <= grid_steps; ++v) {
            Point p;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = (double(corners[0][i]) * (grid_steps - u - v) + double(corners[1][i]) * u +
                        double(corners[2][i]) * v) /
                       grid_steps;
            }
            const auto holds = [&](const Aabb& box) { return is_inside(box, p, slack); };
            if (std::ranges::none_of(boxes, holds)) return false;
        }
    }
    return true;
}

}  // namespace

bool is_covered(const LeafPair& pair, std::span<const Aabb> boxes) {
    const auto& v = pair.vertices;
    return is_triangle_covered({v[0], v[1], v[2]}, boxes) &&
           (!pair.has_second() || is_triangle_covered({v[0], v[2], v[3]}, boxes));
}

}  // namespace rtu::model
