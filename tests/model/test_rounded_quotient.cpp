#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "exact_reference.hpp"
#include "meshes.hpp"
#include "model/rounded_quotient.hpp"
#include "model/vec3.hpp"

namespace rtu::model {
namespace {

using test::Random;
using test::Rational;

using Sum = ExactSum<8>;

Rational exact(const Sum& sum) {
    Rational result = 0;
    for (const double component : sum.components()) result += Rational(component);
    return result;
}

// Whether doubles alone could tell.
bool is_certain(const Sum& above, const Sum& below) {
    return quotient_ends({above.value()}, {below.value()}, 1 / below.value()).are_equal();
}

void expect_rounded_once(const Sum& above, const Sum& below) {
    const float rounded = rounded_quotient(above, below);
    const float expected = test::rounded_once(exact(above) / exact(below));
    ASSERT_EQ(rounded, expected) << above.value() << " / " << below.value();
    ASSERT_EQ(std::signbit(rounded), (above.value() < 0) != (below.value() < 0) && above.value() != 0);
}

double any_double(Random& random, int exponents) {
    const double digits = std::ldexp(random.uniform(-1, 1), -24) + double(random.uniform(-1, 1));
    return std::ldexp(digits, int(random.below(std::uint32_t(2 * exponents))) - exponents);
}

TEST(RoundedQuotient, IsThatOfRationalArithmeticForAnyNumbers) {
    Random random(51);
    for (int i = 0; i < 20'000; ++i) {
        Sum above, below;
        for (int k = 0; k < 3; ++k) {
            above.add(any_double(random, 100));
            below.add(any_double(random, 40));
        }
        if (below.value() == 0) continue;
        ASSERT_NO_FATAL_FAILURE(expect_rounded_once(above, below));
    }
}

// The number half way between two floats of any size: next to zero, subnormal, normal, next to infinity.
double any_middle(Random& random) {
    const std::uint32_t most_bits = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max());
    const std::uint32_t bits = random.below(8) == 0   ? random.below(4)
                               : random.below(8) == 0 ? most_bits - random.below(2)
                               : random.below(4) == 0 ? random.below(1U << 23U)
                                                      : random.below(most_bits);
    const double low = std::bit_cast<float>(bits);
    const double high = bits == most_bits ? 0x1p128 : double(std::bit_cast<float>(bits + 1));
    return (random.below(2) == 0 ? 0.5 : -0.5) * (low + high);
}

// Exactly half way between two floats, and off by far less than a double can show.
TEST(RoundedQuotient, TellsATieFromWhatIsNextToIt) {
    Random random(52);
    int uncertain = 0, count = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double middle = any_middle(random), factor = any_double(random, 40);
        for (const int off : {-1, 0, 1}) {
            Sum above, below;
            for (const double part : {factor, std::ldexp(any_double(random, 1), -90) * factor}) {
                below.add(part);
                above.add(part * middle);
                above.add(std::fma(part, middle, -part * middle));
            }
            above.add(off * std::ldexp(middle * factor, -65 - int(random.below(100))));
            uncertain += is_certain(above, below) ? 0 : 1;
            ++count;
            ASSERT_NO_FATAL_FAILURE(expect_rounded_once(above, below));
        }
    }
    EXPECT_EQ(uncertain, count);
}

// A quotient that is a float is no reason for exact arithmetic.
TEST(RoundedQuotient, IsCertainOfAFloat) {
    Random random(53);
    for (int i = 0; i < 1'000; ++i) {
        const double factor = 1 + random.below(1U << 20U);
        Sum above, below;
        above.add(factor * double(random.uniform(-1, 1)));
        below.add(factor);
        ASSERT_TRUE(is_certain(above, below));
        ASSERT_NO_FATAL_FAILURE(expect_rounded_once(above, below));
    }
}

TEST(RoundedQuotient, OverflowsUnderflowsAndSignsZerosAsIeee754) {
    const auto quotient = [](double above, double below) {
        return rounded_quotient(ExactSum(std::array{above}), ExactSum(std::array{below}));
    };
    EXPECT_EQ(quotient(0x1.fffffep127, 1), 0x1.fffffep127F);
    EXPECT_EQ(quotient(0x1.fffffefffffffp127, 1), 0x1.fffffep127F);
    EXPECT_EQ(quotient(0x1.ffffffp127, 1), infinity);
    EXPECT_EQ(quotient(0x1.ffffffp127, -1), -infinity);
    EXPECT_EQ(quotient(0x1p300, 0x1p-100), infinity);
    EXPECT_EQ(quotient(0x1p-150, 1), 0.0F);
    EXPECT_EQ(quotient(0x1.0000000000001p-150, 1), 0x1p-149F);
    EXPECT_EQ(quotient(3, 0x1p150), 0x1p-148F);
    EXPECT_TRUE(std::signbit(quotient(-0x1p-300, 1)));
    EXPECT_FALSE(std::signbit(quotient(0, -1)));
}

}  // namespace
}  // namespace rtu::model
