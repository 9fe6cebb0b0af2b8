#pragma once

#include <cstdint>
#include <vector>

namespace rtu::model {

struct CirclePoint {
    float cosine = 0;
    float sine = 0;
};

/// `count` points (a power of two, at least 4) evenly around the unit circle, counter-clockwise from (1, 0).
/// By halving arcs, without library trigonometry, whose last bits differ between machines.
[[nodiscard]] std::vector<CirclePoint> unit_circle(std::uint32_t count);

}  // namespace rtu::model
