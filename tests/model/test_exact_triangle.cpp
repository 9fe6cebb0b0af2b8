#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact_reference.hpp"
#include "meshes.hpp"
#include "model/exact_sum.hpp"
#include "model/exact_triangle.hpp"

namespace rtu::model {
namespace {

using test::ExactView;
using test::Random;
using test::Rational;

int sign(double x) { return (x > 0) - (x < 0); }

std::uint8_t largest_axis(Vec3 d) {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

// The sign of the edge function is that of the sheared plane times the sign of the direction along the axis.
int side(const Line& line, Vec3 p, Vec3 q) {
    const ExactTriangle triangle(line, {p, q, p});
    return int(triangle.side(0, triangle.edge_function(0))) * (line.direction[line.axis] > 0 ? 1 : -1);
}

void expect_as_oracle(Vec3 origin, Vec3 direction, Vec3 p, Vec3 q) {
    if (direction == Vec3{}) return;
    const Line line{origin, direction, largest_axis(direction)};
    const ExactView view(origin, direction, line.axis);
    ASSERT_EQ(side(line, p, q), view.side(p, q));
    ASSERT_EQ(side(line, q, p), -view.side(p, q));
}

// Numbers of all sizes, zeros and subnormals among them.
Vec3 wild(Random& random) {
    const auto number = [&] {
        if (random.below(6) == 0) return 0.0F;
        return std::ldexp(random.uniform(-1, 1), int(random.below(270)) - 145);
    };
    return {number(), number(), number()};
}

Vec3 on_grid(Random& random) {
    const auto number = [&] { return float(int(random.below(9)) - 4); };
    return {number(), number(), number()};
}

TEST(ExactTriangle, HasTheSideOfRationalArithmetic) {
    Random random(31);
    for (int i = 0; i < 20'000; ++i) {
        expect_as_oracle(wild(random), wild(random), wild(random), wild(random));
        expect_as_oracle(on_grid(random), on_grid(random), on_grid(random), on_grid(random));
    }
}

// Rays aimed at a point of the edge, whose rounding to binary32 is all that separates the two.
TEST(ExactTriangle, TellsSidesThatDifferByRoundingOnly) {
    Random random(32);
    for (int i = 0; i < 20'000; ++i) {
        const float offset = std::ldexp(1.0F, int(random.below(24)));
        const Vec3 far{offset, -offset, offset};
        const Vec3 p = far + random.point(-1, 1), q = far + random.point(-1, 1);
        const Vec3 origin = random.point(-4, 4);
        expect_as_oracle(origin, p + (q - p) * random.uniform(0, 1) - origin, p, q);
    }
}

TEST(ExactTriangle, HasAMagnitudeWithinItsBound) {
    Random random(33);
    for (int i = 0; i < 5'000; ++i) {
        const float size = std::ldexp(1.0F, -int(random.below(20)));
        const Line line{random.point(-9, 9), random.point(-1, 1), 0};
        const Vec3 p = random.point(-9, 9), q = p + random.point(-1, 1) * size;
        const auto part = [](Vec3 v, Vec3 from, std::size_t axis) {
            return Rational(Rational(double(v[axis])) - Rational(double(from[axis])));
        };
        Rational exact = 0;
        double length = 0, reach = 0, extent = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
            exact += Rational(double(line.direction[k])) *
                     (part(p, line.origin, m) * part(q, p, n) - part(p, line.origin, n) * part(q, p, m));
            length += std::abs(double(line.direction[k]));
            reach = std::max(reach, std::abs(double(p[k]) - double(line.origin[k])));
            extent = std::max(extent, std::abs(double(q[k]) - double(p[k])));
        }
        const Rational error = Rational(ExactTriangle(line, {p, q, p}).edge_function(0).value) - exact;
        ASSERT_LE(std::abs(error.convert_to<double>()), 0x1p-48 * length * reach * extent);
    }
}

TEST(ExactSum, KeepsWhatDoublesLose) {
    EXPECT_EQ(ExactSum(std::array{1.0, 0x1p-100, -1.0}).value(), 0x1p-100);
    EXPECT_EQ(ExactSum(std::array{0x1p200, 1.0, -0x1p200, -1.0}).value(), 0.0);
    EXPECT_EQ(ExactSum(std::array{0x1p-400, 0x1p300, -0x1p-401, -0x1p300}).value(), 0x1p-401);
}

// The sum of the components must not cancel to zero when they are long runs of ones.
TEST(ExactSum, HasTheSignOfTheSum) {
    Random random(34);
    for (int i = 0; i < 20'000; ++i) {
        std::array<double, 12> summands{};
        Rational exact = 0;
        for (double& s : summands) {
            s = std::ldexp(double(1 + random.below(3)), int(random.below(120)) - 60);
            s = random.below(2) == 0 ? s : -s * (1 - 0x1p-53);
            exact += Rational(s);
        }
        ASSERT_EQ(sign(ExactSum(summands).value()), exact > 0 ? 1 : exact < 0 ? -1 : 0);
    }
}

}  // namespace
}  // namespace rtu::model
