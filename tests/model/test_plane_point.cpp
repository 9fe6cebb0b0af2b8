#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "exact_reference.hpp"
#include "meshes.hpp"
#include "model/exact_triangle.hpp"
#include "model/vec3.hpp"

// t, u and v of a hit against rational arithmetic, where binary64 can tell how they round and where it
// cannot.
namespace rtu::model {
namespace {

using test::Random;
using test::Rational;

struct Meeting {
    Vec3 origin, direction;
    std::array<Vec3, 3> corners;
};

// Whether a number lies so near half way between two floats that no double tells the side.
bool is_beyond_doubles(const Rational& exact) {
    if (exact == 0) return false;
    const float nearest = test::rounded_once(abs(exact));
    const auto widen = [](float x) { return std::isinf(x) ? 0x1p128 : double(x); };
    for (const float to : {0.0F, infinity}) {
        const Rational middle = (Rational(widen(nearest)) + Rational(widen(std::nextafter(nearest, to)))) / 2;
        if (abs(abs(exact) - middle) <= abs(exact) * Rational(0x1p-53)) return true;
    }
    return false;
}

struct Tally {
    int hits = 0;
    int subnormal = 0, infinite = 0;      // of t
    std::array<int, 3> beyond_doubles{};  // of t, u, v
};

void expect_rounded_once(const Meeting& m, Tally& tally) {
    const auto& [a, b, c] = m.corners;
    if (m.direction == Vec3{} || !is_finite(m.direction) || !is_finite(m.origin)) return;
    if (!is_finite(a) || !is_finite(b) || !is_finite(c)) return;
    const Vec3 d = m.direction;
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const std::uint8_t axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const auto expected = test::exact_hit({m.origin, d, axis}, m.corners, axis, d[axis]);
    if (!expected) return;
    const ExactTriangle triangle({m.origin, d, axis}, m.corners);
    std::array<Bounded, 3> edge_functions{};
    for (std::size_t edge = 0; edge < 3; ++edge) edge_functions[edge] = triangle.edge_function(edge);
    const auto found = triangle.point_beyond(-infinity, edge_functions);
    const std::array exact{expected->t, expected->u, expected->v};
    const std::array rounded{test::rounded_once(exact[0]), test::rounded_once(exact[1]),
                             test::rounded_once(exact[2])};
    ASSERT_EQ(found.has_value(), rounded[0] != -infinity);
    ASSERT_FALSE(triangle.point_beyond(rounded[0], edge_functions));
    if (!found) return;
    ASSERT_TRUE(triangle.point_beyond(std::nextafter(rounded[0], -infinity), edge_functions));
    ASSERT_EQ(found->t, rounded[0]);
    ASSERT_EQ(found->u, rounded[1]);
    ASSERT_EQ(found->v, rounded[2]);
    ASSERT_EQ(std::signbit(found->t), exact[0] < 0);
    ASSERT_FALSE(std::signbit(found->u) || std::signbit(found->v));
    ++tally.hits;
    tally.subnormal += std::fpclassify(found->t) == FP_SUBNORMAL ? 1 : 0;
    tally.infinite += std::isinf(found->t) ? 1 : 0;
    for (std::size_t i = 0; i < 3; ++i) tally.beyond_doubles[i] += is_beyond_doubles(exact[i]) ? 1 : 0;
}

// Turned to other axes and scaled by powers of two, which moves no tie.
Meeting turned(const Meeting& m, Random& random) {
    const std::size_t first = random.below(3);
    const bool is_swapped = random.below(2) == 0;
    const std::array<float, 3> sign{random.below(2) == 0 ? 1.0F : -1.0F, random.below(2) == 0 ? 1.0F : -1.0F,
                                    random.below(2) == 0 ? 1.0F : -1.0F};
    const float size = std::ldexp(1.0F, int(random.below(160)) - 80);
    const float speed = std::ldexp(1.0F, int(random.below(60)) - 30);
    const auto turn = [&](Vec3 v, float scale) {
        if (is_swapped) std::swap(v.x, v.y);
        Vec3 result;
        for (std::size_t k = 0; k < 3; ++k) result[(first + k) % 3] = v[k] * sign[k] * scale;
        return result;
    };
    const std::size_t corner = random.below(3);
    return {turn(m.origin, size),
            turn(m.direction, speed),
            {turn(m.corners[corner], size), turn(m.corners[(corner + 1) % 3], size),
             turn(m.corners[(corner + 2) % 3], size)}};
}

// t = T, an odd number of 25 bits: half way between two floats. The plane has normal (-p, -q, 1), whose
// product with the direction is 1. Corners are multiples of 32 below 2^29, so that they are floats; the
// origin's z makes up for it. Far less than a double's ulp moves t off the tie.
Meeting distance_at_tie(Random& random) {
    const auto small = [&] { return double(int(random.below(3)) - 1); };
    const double T = 0x1p24 + 2 * double(random.below(1U << 23U)) + 1;
    const double p = small(), q = small(), dx = small(), dy = small(), L = 0x1p26;
    const double ox = 32 * double(random.below(2) * random.below(1000)), oy = 32 * double(random.below(1000));
    const auto to_32 = [](double x) { return 32 * std::floor(x / 32); };
    const double ax = to_32(ox + T * dx) - L, ay = to_32(oy + T * dy) - L;
    const double rest = T + p * (ax - ox) + q * (ay - oy);
    const double az = to_32(rest), oz = az - rest;
    const auto point = [](double x, double y, double z) { return Vec3{float(x), float(y), float(z)}; };
    const double off = ox == 0 ? std::ldexp(small(), -60 - int(random.below(80))) : 0;
    return {
        point(ox + off, oy, oz),
        point(dx, dy, 1 + p * dx + q * dy),
        {point(ax, ay, az), point(ax + 4 * L, ay, az + 4 * L * p), point(ax, ay + 4 * L, az + 4 * L * q)}};
}

// u or v = (k + 1/2) / 2^24 with k of 24 bits, or all but that.
Meeting barycentric_at_tie(Random& random) {
    const auto k = float((1U << 23U) + random.below(1U << 22U));
    const float other = 1 + float(random.below(1U << 20U)), depth = random.below(2) == 0 ? 1.0F : -1.0F;
    const float off = random.below(2) == 0 ? 0 : std::ldexp(random.below(2) == 0 ? 1.0F : -1.0F, -60);
    const std::array<Vec3, 3> corners{Vec3{0, 0, depth}, {0x1p24F, 0, depth}, {0, 0x1p24F, depth}};
    if (random.below(2) == 0) return {{k, other, 0}, {0.5F * depth, off, depth}, corners};
    return {{k, other, off}, {0.5F * depth, 0, depth}, corners};
}

// From any distance down to none, at any angle, with needles.
Meeting near_or_far(Random& random) {
    const auto any_size = [&](std::uint32_t below) { return std::ldexp(1.0F, -int(random.below(below))); };
    const Vec3 a = random.point(-4, 4), b = a + random.point(-1, 1) * any_size(12);
    const Vec3 c = a + (b - a) * random.uniform(-1, 1) + random.point(-1, 1) * any_size(20);
    const Vec3 inside = a * 0.5F + b * 0.25F + c * 0.25F;
    const std::array<Vec3, 4> targets{a, a + (b - a) * 0.25F, inside, inside};
    const Vec3 target = targets[random.below(4)];
    const Vec3 origin = target + random.point(-1, 1) * any_size(80);
    const Vec3 direction = random.below(2) == 0 ? target - origin : random.point(-1, 1);
    return {origin, direction, {a, b, c}};
}

// Numbers of all sizes, of which some make a triangle that the ray pierces; subnormal and infinite t.
Meeting of_all_sizes(Random& random) {
    const auto number = [&](int spread) {
        return std::ldexp(random.uniform(-1, 1), int(random.below(std::uint32_t(spread))) - spread / 2);
    };
    const float size = std::ldexp(1.0F, int(random.below(200)) - 110);
    const auto point = [&] { return Vec3{number(20), number(20), number(20)} * size; };
    const Vec3 a = point(), b = point(), c = point(), origin = random.below(4) == 0 ? a : point();
    const Vec3 towards = (a + b + c) * 0.3333F - origin;
    return {origin, towards * std::ldexp(1.0F, int(random.below(270)) - 145), {a, b, c}};
}

// Nearly parallel to the plane, whose corners are on a grid.
Meeting near_parallel(Random& random) {
    const auto grid = [&] { return float(int(random.below(65)) - 32); };
    const Vec3 a{grid(), grid(), grid()}, b{grid(), grid(), grid()}, c{grid(), grid(), grid()};
    const Vec3 in_plane = (b - a) * random.uniform(-1, 1) + (c - a) * random.uniform(-1, 1);
    const Vec3 target = a * 0.5F + b * 0.25F + c * 0.25F;
    return {target - in_plane, in_plane, {a, b, c}};
}

struct Kind {
    const char* name;
    Meeting (*draw)(Random&);
    int least_hits;
    std::array<int, 3> least_beyond_doubles;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class PlanePoints : public testing::TestWithParam<Kind> {};

TEST_P(PlanePoints, AreTheExactOnesRoundedOnce) {
    Random random(61);
    Tally tally;
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        const Meeting drawn = GetParam().draw(random);
        ASSERT_NO_FATAL_FAILURE(expect_rounded_once(i % 2 == 0 ? drawn : turned(drawn, random), tally))
            << "meeting " << i;
    }
    EXPECT_GE(tally.hits, GetParam().least_hits);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(tally.beyond_doubles[k], GetParam().least_beyond_doubles[k]) << k;
    }
    if (std::string_view(GetParam().name) == "OfAllSizes") {
        EXPECT_GE(tally.subnormal, 100);
        EXPECT_GE(tally.infinite, 100);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, PlanePoints,
    testing::Values(Kind{"DistanceAtTie", distance_at_tie, 15'000, {15'000, 0, 0}},
                    Kind{"BarycentricAtTie", barycentric_at_tie, 15'000, {0, 9'000, 3'000}},
                    Kind{"NearOrFar", near_or_far, 5'000, {0, 0, 0}},
                    Kind{"OfAllSizes", of_all_sizes, 5'000, {0, 0, 0}},
                    Kind{"NearParallel", near_parallel, 5'000, {0, 0, 0}}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(PlanePoint, OverflowsAndUnderflowsAsIeee754) {
    const auto distance = [](float origin_z, float direction_z, float plane_z) {
        const std::array<Vec3, 3> corners{Vec3{-1, -1, plane_z}, {3, -1, plane_z}, {-1, 3, plane_z}};
        const ExactTriangle triangle({{0, 0, origin_z}, {0, 0, direction_z}, 2}, corners);
        return triangle
            .point_beyond(-infinity,
                          {triangle.edge_function(0), triangle.edge_function(1), triangle.edge_function(2)})
            ->t;
    };
    constexpr float largest = std::numeric_limits<float>::max();
    EXPECT_EQ(distance(-0x1p103F, 1, largest), infinity);
    EXPECT_EQ(distance(-0x1.fffffep102F, 1, largest), largest);
    EXPECT_EQ(distance(0, 0x1p-149F, largest), infinity);
    EXPECT_EQ(distance(0, 2, 0x3p-149F), 0x2p-149F);
    EXPECT_EQ(distance(0, 2, 0x1p-149F), 0.0F);
    EXPECT_EQ(distance(-0x1p-149F, 4, 0x2p-149F), 0x1p-149F);
    EXPECT_TRUE(std::signbit(distance(0, 4, -0x1p-149F)));
    EXPECT_FALSE(std::signbit(distance(5, -1, 5)));
}

}  // namespace
}  // namespace rtu::model
