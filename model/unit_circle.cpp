#include "model/unit_circle.hpp"

#include <cmath>

namespace rtu::model {

namespace {

CirclePoint middle_of_arc(CirclePoint a, CirclePoint b) {
    const float x = a.cosine + b.cosine;
    const float y = a.sine + b.sine;
    const float length = std::sqrt(x * x + y * y);
    return {x / length, y / length};
}

}  // namespace

std::vector<CirclePoint> unit_circle(std::uint32_t count) {
    std::vector<CirclePoint> points{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    while (points.size() < count) {
        std::vector<CirclePoint> finer;
        for (std::size_t i = 0; i < points.size(); ++i) {
            finer.push_back(points[i]);
            finer.push_back(middle_of_arc(points[i], points[(i + 1) % points.size()]));
        }
        points = finer;
    }
    return points;
}

}  // namespace rtu::model
