#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "model/methods/method.hpp"

namespace rtu::test {

using model::Vec3;

/// A ray and a triangle to test it against.
struct MethodCase {
    model::Ray ray;
    model::methods::Corners triangle;
};

/// Corners, origin and aim from small to large, near edges and vertices more often than not.
class MethodCases {
  public:
    explicit MethodCases(std::uint32_t seed) : random_(seed) {}
    MethodCase next() {
        const float scale = std::ldexp(1.0F, int(random_() % 9) * 14 - 62);
        const float offset = random_() % 4 == 0 ? scale * 1000 : 0;
        MethodCase c;
        for (Vec3& corner : c.triangle) corner = point(scale, offset);
        c.ray.origin = point(scale, offset);
        const float s = weight(), r = weight();
        const Vec3 aim = c.triangle[0] * (1 - s - r) + c.triangle[1] * s + c.triangle[2] * r;
        c.ray.direction = aim - c.ray.origin;
        if (random_() % 8 == 0) c.ray.direction = axis_parallel();
        if (random_() % 8 == 0) c.triangle[2] = c.triangle[random_() % 2];
        c.ray.t_max = random_() % 2 == 0 ? std::numeric_limits<float>::infinity() : 1.0F;
        return c;
    }

  private:
    float uniform() { return float(random_() >> 8) * 0x1p-24F; }
    float weight() { return random_() % 2 == 0 ? float(random_() % 3) * 0.5F : uniform(); }
    Vec3 point(float scale, float offset) {
        const float x = uniform(), y = uniform(), z = uniform();
        return {x * scale + offset, y * scale, z * scale - offset};
    }
    Vec3 axis_parallel() {
        Vec3 d{0, random_() % 2 == 0 ? 0.0F : -0.0F, 0};
        d[random_() % 3] = random_() % 2 == 0 ? 1.0F : -1.0F;
        return d;
    }
    std::mt19937 random_;
};

}  // namespace rtu::test
