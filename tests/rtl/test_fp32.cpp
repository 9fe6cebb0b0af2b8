#include <Vfp32_ops.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "rtl_ref/harness/clock.hpp"
#include "vectors.hpp"

namespace rtu {
namespace {

using test::bits_of;
using test::RandomBits;

struct Operands {
    float a, b;
};

// Expected results wait as many cycles as the operation takes.
class Delayed {
  public:
    explicit Delayed(std::size_t latency) : waiting_(latency) {}
    std::optional<Operands> next(Operands in) {
        waiting_.push_back(in);
        const auto out = waiting_.front();
        waiting_.pop_front();
        return out;
    }

  private:
    std::deque<std::optional<Operands>> waiting_;
};

void expect_result(const char* operation, Operands in, std::uint32_t value, float expected) {
    ASSERT_TRUE(test::is_same(value, bits_of(expected)))
        << std::hex << bits_of(in.a) << ' ' << operation << ' ' << bits_of(in.b) << ": " << value << " for "
        << bits_of(expected);
}

struct Kind {
    const char* name;
    std::function<Operands(RandomBits&)> draw;
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

class Fp32 : public testing::TestWithParam<Kind> {};

TEST_P(Fp32, GivesTheBitsOfTheHost) {
    Vfp32_ops unit;
    RandomBits random(11);
    unit.en_i = 1;
    rtl::settle(unit);
    Delayed products(unit.mul_latency_o), sums(unit.add_latency_o), comparisons(1);
    const std::uint64_t count = test::vector_count(1'000'000) / 7;
    for (std::uint64_t i = 0; i < count && !HasFatalFailure(); ++i) {
        const Operands in = GetParam().draw(random);
        unit.a_i = bits_of(in.a);
        unit.b_i = bits_of(in.b);
        rtl::settle(unit);
        if (const auto x = products.next(in)) expect_result("*", *x, unit.product_o, x->a * x->b);
        if (const auto x = sums.next(in)) expect_result("+", *x, unit.sum_o, x->a + x->b);
        if (const auto x = comparisons.next(in)) {
            ASSERT_EQ(bool(unit.is_less_o), x->a < x->b) << x->a << " < " << x->b;
            expect_result("* 2^-20, not", *x, unit.halved_o, x->a * 0x1p-20F);
            expect_result("max", *x, unit.larger_o, std::max(x->a, x->b));
            expect_result("min", *x, unit.smaller_o, std::min(x->a, x->b));
        }
        rtl::clock_edge(unit);
    }
}

// Exponents close together, and often differing in the last bits only.
Operands cancelling(RandomBits& random) {
    const std::uint32_t exponent = 3 + random.below(248);
    const float a = random.of_exponent(exponent, 1);
    if (random.one_in(4)) return {a, test::float_of((bits_of(a) ^ 0x80000000U) + random.below(9) - 4)};
    return {a, random.of_exponent(exponent - 2, 5)};
}

// Products and sums around the least normal number.
Operands tiny(RandomBits& random) {
    const float a = random.of_exponent(0, 30);
    return {a, random.one_in(2) ? random.of_exponent(0, 30) : random.of_exponent(100, 50)};
}

// Few bits far apart: exact ties, and what differs from a tie in the last place only.
Operands sparse(RandomBits& random) {
    const auto number = [&] {
        const std::uint32_t fraction = (1U << random.below(24) | 1U << random.below(24)) & 0x7fffffU;
        return test::float_of((bits_of(random.of_exponent(40, 60)) & 0xff800000U) | fraction);
    };
    return {number(), number()};
}

// Products within a unit in the last place of half a subnormal one.
Operands near_tie(RandomBits& random) {
    const float a = random.of_exponent(30, 60);
    const double product = (double(random.below(1U << random.below(12))) + 0.5) * 0x1p-149;
    return {a, float(product / double(a))};
}

Operands with_special(RandomBits& random) {
    return {random.one_in(2) ? random.special() : random.any(),
            random.one_in(2) ? random.special() : random.any()};
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Fp32,
    testing::Values(Kind{"AnyBits",
                         [](RandomBits& r) {
                             return Operands{r.any(), r.any()};
                         }},
                    Kind{"Normal",
                         [](RandomBits& r) {
                             return Operands{r.of_exponent(64, 128), r.of_exponent(64, 128)};
                         }},
                    Kind{"Cancelling", cancelling}, Kind{"Tiny", tiny}, Kind{"Sparse", sparse},
                    Kind{"NearTie", near_tie}, Kind{"Special", with_special}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Fp32, StandsStillWithoutEnable) {
    Vfp32_ops unit;
    unit.en_i = 1;
    unit.a_i = bits_of(3);
    unit.b_i = bits_of(5);
    for (int i = 0; i < 8; ++i) {
        rtl::settle(unit);
        rtl::clock_edge(unit);
    }
    unit.en_i = 0;
    unit.a_i = bits_of(7);
    for (int i = 0; i < 8; ++i) {
        rtl::settle(unit);
        EXPECT_EQ(unit.product_o, bits_of(15));
        EXPECT_EQ(unit.sum_o, bits_of(8));
        EXPECT_EQ(unit.larger_o, bits_of(5));
        rtl::clock_edge(unit);
    }
}

}  // namespace
}  // namespace rtu
