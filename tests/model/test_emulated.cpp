#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "model/methods/emulated.hpp"
#include "model/methods/exact.hpp"
#include "tests/model/method_cases.hpp"

namespace rtu::model::methods {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Every finite number of a format that is not negative, in order, decoded from its bits; then what would come
// next, were the exponent unlimited.
std::vector<double> numbers_of(NumberFormat format) {
    std::vector<double> numbers;
    const int places = 1 << format.mantissa_bits;
    for (int exponent = 0; exponent < (1 << format.exponent_bits) - 1; ++exponent) {
        for (int mantissa = 0; mantissa < places; ++mantissa) {
            const int significand = exponent == 0 ? mantissa : places + mantissa;
            numbers.push_back(std::ldexp(
                significand, std::max(exponent, 1) - 1 + format.least_exponent() - format.mantissa_bits));
        }
    }
    numbers.push_back(std::ldexp(1.0, format.largest_exponent() + 1));
    return numbers;
}

class SmallFormat : public testing::TestWithParam<NumberFormat> {};

// All numbers, all ties between neighbours and what is just beside the ties.
TEST_P(SmallFormat, RoundsToTheNearestNumberTiesToEven) {
    const NumberFormat format = GetParam();
    const std::vector<double> numbers = numbers_of(format);
    for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
        const double below = numbers[i];
        const double above = i + 2 < numbers.size() ? numbers[i + 1] : infinity;
        const double tie = (below + numbers[i + 1]) / 2;
        const double even = i % 2 == 0 ? below : above;
        ASSERT_EQ(rounded(format, below), below) << i;
        ASSERT_EQ(rounded(format, std::nextafter(tie, 0.0)), below) << i;
        ASSERT_EQ(rounded(format, tie), even) << i;
        ASSERT_EQ(rounded(format, std::nextafter(tie, infinity)), above) << i;
        ASSERT_EQ(rounded(format, -tie), -even) << i;
        ASSERT_EQ(std::signbit(rounded(format, -std::nextafter(tie, 0.0))), true) << i;
    }
    EXPECT_EQ(rounded(format, -infinity), -infinity);
    EXPECT_EQ(rounded(format, 1e308), infinity);
    EXPECT_TRUE(std::isnan(rounded(format, std::nan(""))));
}

INSTANTIATE_TEST_SUITE_P(Formats, SmallFormat,
                         testing::Values(NumberFormat{5, 10}, NumberFormat{8, 7}, NumberFormat{10, 7},
                                         NumberFormat{8, 10}, NumberFormat{4, 3}),
                         [](const auto& format) { return to_string(format.param); });

bool is_same(double emulated, float native) {
    if (std::isnan(native)) return std::isnan(emulated);
    return emulated == double(native) && std::signbit(emulated) == std::signbit(native);
}

TEST(Emulated, OfBinary32IsBinary32) {
    std::mt19937 random(11);
    const auto is_small = [](float x) { return x != 0 && std::abs(x) < std::numeric_limits<float>::min(); };
    int subnormal_count = 0;
    for (int i = 0; i < 2'000'000; ++i) {
        std::uint32_t bits = std::uint32_t(random());
        const float a = std::bit_cast<float>(bits);
        // Every third pair has exponents alike, so that sums and quotients round in every way.
        const std::uint32_t other = std::uint32_t(random());
        bits = i % 3 == 0 ? (bits & 0x7f00'0000U) | (other & 0x80ff'ffffU) : other;
        const float b = std::bit_cast<float>(bits);
        const Emulated x(binary32, double(a)), y(binary32, double(b));
        ASSERT_TRUE(is_same((x + y).value, a + b)) << a << " + " << b;
        ASSERT_TRUE(is_same((x - y).value, a - b)) << a << " - " << b;
        ASSERT_TRUE(is_same((x * y).value, a * b)) << a << " * " << b;
        ASSERT_TRUE(is_same((x / y).value, a / b)) << a << " / " << b;
        subnormal_count += is_small(a / b) || is_small(a * b) ? 1 : 0;
    }
    EXPECT_GT(subnormal_count, 10'000);
}

TEST(Emulated, TakesTheFormatOfWhatMeetsAConstant) {
    const NumberFormat format{8, 7};
    const Emulated third = Emulated(1.0F) / Emulated(format, 3.0);
    EXPECT_EQ(third.value, 0x1.56p-2);
    EXPECT_EQ((third - Emulated(1.0F)).format, format);
    EXPECT_EQ((Emulated(1.0F) + Emulated(1.0F)).value, 2.0);
    EXPECT_TRUE(std::signbit(magnitude(-third).value) == false && flip_sign(third, -third).value < 0);
    EXPECT_FALSE(has_same_sign(Emulated(format, 0.0), Emulated(format, -0.0)));
}

TEST(EmulatedMethods, InBinary32AreTheMethodsToTheBit) {
    for (const EmulatedMethod& method : emulated_methods()) {
        const Method& native = *find_method(method.info.name);
        test::MethodCases cases(3);
        int hits = 0;
        for (int i = 0; i < 30'000; ++i) {
            const test::MethodCase c = cases.next();
            const auto expected = native.test(c.ray, c.triangle);
            const auto got = method.test(c.ray, c.triangle, binary32);
            ASSERT_EQ(got.has_value(), expected.has_value()) << method.info.name << ", case " << i;
            if (!got) continue;
            ++hits;
            ASSERT_TRUE(is_same(got->t, expected->t)) << method.info.name << ", case " << i;
            ASSERT_TRUE(is_same(got->u, expected->u)) << method.info.name << ", case " << i;
            ASSERT_TRUE(is_same(got->v, expected->v)) << method.info.name << ", case " << i;
        }
        EXPECT_GT(hits, 1500) << method.info.name;
    }
}

TEST(EmulatedMethods, AreAllButThoseThatAreNotMadeOfRoundedArithmetic) {
    const std::set<std::string_view> others{"exact", "woop_exact", "havel_herout_sse4"};
    for (const Method& method : all_methods()) {
        const auto is_it = [&](const EmulatedMethod& one) { return one.info.name == method.info.name; };
        EXPECT_NE(std::ranges::any_of(emulated_methods(), is_it), others.contains(method.info.name))
            << method.info.name;
    }
}

// A one-sided method sees a triangle in one of its windings.
std::optional<EmulatedHit> hit_of(const EmulatedMethod& method, const Ray& ray, const Corners& triangle,
                                  NumberFormat format) {
    const auto hit = method.test(ray, triangle, format);
    if (hit || !method.info.is_one_sided) return hit;
    return method.test(ray, {triangle[0], triangle[2], triangle[1]}, format);
}

TEST(EmulatedMethods, LoseAccuracyBitByBit) {
    const Corners triangle{Vec3{0.1F, 0.2F, 3.3F}, Vec3{1.7F, 0.1F, 3.1F}, Vec3{0.3F, 1.9F, 2.7F}};
    const Ray ray{{0.3F, 0.4F, 0}, 0, {0.13F, 0.11F, 0.97F}, 100};
    const double t = double(test_exactly(ray, triangle).value().t);
    for (const EmulatedMethod& method : emulated_methods()) {
        for (const int bits : {7, 11, 15, 19, 23}) {
            const auto hit = hit_of(method, ray, triangle, {8, std::uint8_t(bits)});
            ASSERT_TRUE(hit) << method.info.name << ", " << bits;
            EXPECT_NEAR(hit->t, t, std::ldexp(60 * t, -bits - 1)) << method.info.name << ", " << bits;
        }
        const auto narrow = hit_of(method, ray, triangle, {8, 7});
        EXPECT_GT(std::abs(narrow->t - t), std::ldexp(t, -20)) << method.info.name;
    }
}

// With exponents of 8 bits, a triangle of size 1e15 overflows all that multiplies three lengths.
TEST(EmulatedMethods, HitHugeTrianglesWithAWiderExponent) {
    const float s = 1e15F;
    const Corners triangle{Vec3{-s, -s, s}, Vec3{s, -s, s}, Vec3{0, s, s}};
    const Ray ray{{0, 0, 0}, 0, {s / 64, s / 128, s / 2}, std::numeric_limits<float>::infinity()};
    int overflows = 0;
    for (const EmulatedMethod& method : emulated_methods()) {
        const auto hit = hit_of(method, ray, triangle, {10, 23});
        ASSERT_TRUE(hit) << method.info.name;
        EXPECT_NEAR(hit->t, 2, 1e-5) << method.info.name;
        overflows += hit_of(method, ray, triangle, binary32) ? 0 : 1;
    }
    EXPECT_GT(overflows, 5);
}

TEST(NumberFormat, IsCalledByItsNameOrItsBits) {
    EXPECT_EQ(to_string(binary32), "fp32");
    EXPECT_EQ(to_string({10, 23}), "fp32e10");
    EXPECT_EQ(to_string({8, 12}), "e8m12");
}

}  // namespace
}  // namespace rtu::model::methods
