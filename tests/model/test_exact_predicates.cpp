#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "model/exact_predicates.hpp"

namespace rtu::model {
namespace {

using Integer = boost::multiprecision::int1024_t;  // products of differences have below 610 bits

/// The float times 2^172, which makes every float an integer: 24 bits, and the least exponent of their lowest
/// bit when subnormals are normalized, -148 - 24.
Integer scaled_integer(float value) {
    int exponent = 0;
    const float mantissa = std::frexp(value, &exponent);
    Integer integer(std::int32_t(std::ldexp(mantissa, 24)));
    integer <<= exponent - 24 + 172;
    return integer;
}

bool oracle(Vec3 a, Vec3 b, Vec3 c) {
    std::array<Integer, 3> u;
    std::array<Integer, 3> v;
    for (std::size_t i = 0; i < 3; ++i) {
        u[i] = scaled_integer(b[i]) - scaled_integer(a[i]);
        v[i] = scaled_integer(c[i]) - scaled_integer(a[i]);
    }
    return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
}

/// The answer must be the oracle's for every order of the corners.
void expect_as_oracle(Vec3 a, Vec3 b, Vec3 c) {
    const bool expected = oracle(a, b, c);
    EXPECT_EQ(is_collinear(a, b, c), expected)
        << "(" << a.x << " " << a.y << " " << a.z << ") (" << b.x << " " << b.y << " " << b.z << ") (" << c.x
        << " " << c.y << " " << c.z << ")";
    EXPECT_EQ(is_collinear(b, a, c), expected);
    EXPECT_EQ(is_collinear(c, b, a), expected);
}

float next_up(float x) { return std::nextafter(x, std::numeric_limits<float>::infinity()); }

TEST(ExactPredicates, CoincidentCornersAreCollinear) {
    const Vec3 p{0.1F, -7.3F, 1e30F};
    const Vec3 q{1e-40F, 2.0F, 3.0F};
    EXPECT_TRUE(is_collinear(p, p, p));
    EXPECT_TRUE(is_collinear(p, p, q));
    EXPECT_TRUE(is_collinear(p, q, p));
    EXPECT_TRUE(is_collinear(q, p, p));
    EXPECT_TRUE(is_collinear({0.0F, 0.0F, 0.0F}, {-0.0F, -0.0F, -0.0F}, q));
}

TEST(ExactPredicates, AProperTriangleIsNotCollinearInAnyCoordinatePlane) {
    EXPECT_FALSE(is_collinear({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    EXPECT_FALSE(is_collinear({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    EXPECT_FALSE(is_collinear({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));
}

TEST(ExactPredicates, SeesAnAreaFarBelowTheRoundingErrorOfTheCoordinates) {
    // The offset of 2^-149 vanishes in every difference with the large coordinates, even with 113 bits.
    const float tiny = std::numeric_limits<float>::denorm_min();
    const float huge = 0x1p127F;
    EXPECT_FALSE(is_collinear({0, 0, 0}, {huge, huge, 0}, {tiny, 0, 0}));
    EXPECT_FALSE(is_collinear({-huge, -huge, 0}, {huge, huge, 0}, {tiny, 0, 0}));
    EXPECT_TRUE(is_collinear({-huge, -huge, 0}, {huge, huge, 0}, {tiny, tiny, 0}));
    EXPECT_TRUE(is_collinear({-huge, 0, huge}, {huge, 0, -huge}, {-tiny, 0, tiny}));
}

TEST(ExactPredicates, ExtremeFiniteCoordinatesNeitherOverflowNorUnderflow) {
    const float most = std::numeric_limits<float>::max();
    EXPECT_TRUE(is_collinear({-most, -most, -most}, {0, 0, 0}, {most, most, most}));
    EXPECT_FALSE(is_collinear({-most, -most, -most}, {0, 0, 0}, {most, most, std::nextafter(most, 0.0F)}));
    const float tiny = std::numeric_limits<float>::denorm_min();
    EXPECT_TRUE(is_collinear({0, 0, 0}, {tiny, tiny, tiny}, {3 * tiny, 3 * tiny, 3 * tiny}));
    EXPECT_FALSE(is_collinear({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}));
}

TEST(ExactPredicates, AgreesWithBigIntegersOnRandomBitPatterns) {
    std::mt19937 random(1);
    const auto any_finite = [&] {
        float f = 0;
        do {
            f = std::bit_cast<float>(std::uint32_t(random()));
        } while (!std::isfinite(f));
        return f;
    };
    const auto point = [&] { return Vec3{any_finite(), any_finite(), any_finite()}; };
    for (int i = 0; i < 2'000; ++i) {
        expect_as_oracle(point(), point(), point());
    }
}

TEST(ExactPredicates, AgreesWithBigIntegersOnSmallGridsWhereLinesAreFrequent) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> coordinate(-2, 2);
    std::uniform_int_distribution<int> exponent(-100, 100);
    int collinear_count = 0;
    for (int i = 0; i < 5'000; ++i) {
        const float scale = std::ldexp(1.0F, exponent(random));
        const auto point = [&] {
            return Vec3{scale * float(coordinate(random)), scale * float(coordinate(random)),
                        scale * float(coordinate(random))};
        };
        const Vec3 a = point();
        const Vec3 b = point();
        const Vec3 c = point();
        expect_as_oracle(a, b, c);
        collinear_count += oracle(a, b, c) ? 1 : 0;
    }
    EXPECT_GT(collinear_count, 100);
}

TEST(ExactPredicates, PointsOfALineAreCollinearAndOneUlpOffTheyAreNot) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> coordinate(-1'000, 1'000);
    std::uniform_int_distribution<int> exponent(-110, 90);
    for (int i = 0; i < 2'000; ++i) {
        // Integers below 2^22 times one power of two: the points of the line are exact.
        const float scale = std::ldexp(1.0F, exponent(random));
        const auto integer_point = [&] {
            return std::array{coordinate(random), coordinate(random), coordinate(random)};
        };
        const std::array<int, 3> start = integer_point();
        const std::array<int, 3> step = integer_point();
        const auto along = [&](int k) {
            return Vec3{scale * float(start[0] + k * step[0]), scale * float(start[1] + k * step[1]),
                        scale * float(start[2] + k * step[2])};
        };
        const Vec3 a = along(0);
        const Vec3 b = along(1 + coordinate(random));
        Vec3 c = along(coordinate(random));
        EXPECT_TRUE(is_collinear(a, b, c));
        expect_as_oracle(a, b, c);
        c[std::size_t(i) % 3] = next_up(c[std::size_t(i) % 3]);
        expect_as_oracle(a, b, c);
    }
}

TEST(ExactPredicates, AgreesWithBigIntegersOnRoundedMidpoints) {
    // Nearly collinear by rounding: what subdivided straight edges look like in real scenes.
    std::mt19937 random(4);
    std::uniform_real_distribution<float> coordinate(-100.0F, 100.0F);
    for (int i = 0; i < 3'000; ++i) {
        const Vec3 a{coordinate(random), coordinate(random), coordinate(random)};
        const Vec3 b{coordinate(random), coordinate(random), coordinate(random)};
        expect_as_oracle(a, b, (a + b) * 0.5F);
        expect_as_oracle({a.x, a.y, 1.0F}, {b.x, b.y, 1.0F}, {(a.x + b.x) * 0.5F, (a.y + b.y) * 0.5F, 1.0F});
    }
}

}  // namespace
}  // namespace rtu::model
