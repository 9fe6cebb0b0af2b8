#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "model/vec3.hpp"
#include "study/oracle/oracle_rational.hpp"
#include "study/oracle/oracle_triangle.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::study {
namespace {

using model::Ray;
using model::Vec3;
using model::methods::Corners;
using test::Random;

using model::infinity;

struct Probe {
    Ray ray;
    Corners corners;
};

float wild_number(Random& random) {
    if (random.below(6) == 0) return 0.0F;
    return std::ldexp(random.uniform(-1, 1), int(random.below(270)) - 145);
}
float tame_number(Random& random) { return std::ldexp(random.uniform(-1, 1), int(random.below(40)) - 20); }
// About as far apart as 256-bit integers can hold, and a little farther.
float wide_number(Random& random) {
    return std::ldexp(random.uniform(-1, 1), random.below(3) == 0 ? -int(random.below(80)) : 0);
}
float grid_number(Random& random) { return float(int(random.below(7)) - 3); }

template <class Number>
Probe anything(Random& random, Number number) {
    const auto vector = [&] { return Vec3{number(random), number(random), number(random)}; };
    const Vec3 origin = vector(), direction = vector();
    return {{origin, 0, direction, infinity}, {vector(), vector(), vector()}};
}

// At a vertex, an edge, the inside or all but the surface, of triangles down to needles, near or far away.
Probe aimed(Random& random) {
    const float offset = std::ldexp(1.0F, int(random.below(24))) - 1;
    const Vec3 far{offset, -offset, 0.5F * offset};
    const Vec3 a = far + random.point(-1, 1), b = far + random.point(-1, 1);
    const float width = std::ldexp(1.0F, -int(random.below(24)));
    const Vec3 c = a + (b - a) * random.uniform(0, 1) + random.point(-1, 1) * width;
    const std::array<Vec3, 4> targets{a, a + (b - a) * random.uniform(0, 1), (a + b + c) * (1.0F / 3),
                                      a + random.point(-1, 1)};
    const Vec3 target = targets[random.below(4)];
    const Vec3 origin = random.below(4) == 0 ? target + random.point(-1, 1) * 1e-6F : random.point(-4, 4);
    return {{origin, 0, target - origin, infinity}, {a, b, c}};
}

bool is_near(double value, const Rational& exact, double scale) {
    const Rational error = abs(Rational(value) - exact);
    return error <= Rational(0x1p-40) * Rational(scale);
}

void expect_same(const OracleDecision& fast, const Probe& probe) {
    const OracleDecision exact = decide_by_rationals(probe.ray, probe.corners);
    ASSERT_EQ(fast.meeting, exact.meeting);
    ASSERT_EQ(fast.feature, exact.feature);
    ASSERT_EQ(fast.is_owner, exact.is_owner);
    ASSERT_EQ(fast.is_in_interval, exact.is_in_interval);
    if (fast.meeting == Meeting::Miss) return;
    const RationalMeeting numbers = meet_exactly(probe.ray, probe.corners);
    EXPECT_TRUE(is_near(fast.t, numbers.t, std::abs(exact.t)));
    EXPECT_TRUE(is_near(fast.u, numbers.u, 1));
    EXPECT_TRUE(is_near(fast.v, numbers.v, 1));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(std::abs(fast.weights[i] - exact.weights[i]), std::abs(exact.weights[i]) * 0x1p-12);
    }
}

bool is_usable(const Probe& probe) { return probe.ray.direction != Vec3{}; }

struct ProbeKind {
    const char* name;
    Probe (*draw)(Random&);
};
void PrintTo(const ProbeKind& kind, std::ostream* out) { *out << kind.name; }

class OracleProbes : public testing::TestWithParam<ProbeKind> {};

// Every arithmetic must have had its turn, or the comparison says nothing about it.
TEST_P(OracleProbes, DecidesAsRationalsDo) {
    Random random(41);
    std::array<int, 3> tiers{};
    for (int i = 0; i < 10'000; ++i) {
        Probe probe = GetParam().draw(random);
        if (!is_usable(probe)) continue;
        if (i % 3 == 1) probe.ray.t_min = 0.5F;
        if (i % 3 == 2) probe.ray.t_max = 1.0F;
        const OracleDecision fast = decide(probe.ray, probe.corners);
        ++tiers[std::size_t(fast.tier)];
        ASSERT_NO_FATAL_FAILURE(expect_same(fast, probe)) << "probe " << i;
        if (const auto integers = decide_by_integers(probe.ray, probe.corners)) {
            ASSERT_NO_FATAL_FAILURE(expect_same(*integers, probe)) << "probe " << i;
        }
        if (is_surely_missed(probe.ray, probe.corners)) {
            ASSERT_EQ(meet_exactly(probe.ray, probe.corners).meeting, Meeting::Miss);
        }
    }
    EXPECT_GT(tiers[0], 1'000);
}

Probe of_all_sizes(Random& random) { return anything(random, wild_number); }
Probe wide(Random& random) { return anything(random, wide_number); }
Probe tame(Random& random) { return anything(random, tame_number); }
Probe on_a_grid(Random& random) { return anything(random, grid_number); }

INSTANTIATE_TEST_SUITE_P(All, OracleProbes,
                         testing::Values(ProbeKind{"OfAllSizes", of_all_sizes}, ProbeKind{"Wide", wide},
                                         ProbeKind{"Tame", tame}, ProbeKind{"OnAGrid", on_a_grid},
                                         ProbeKind{"Aimed", aimed}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Oracle, UsesEveryArithmetic) {
    Random random(42);
    std::array<int, 3> tiers{};
    for (int i = 0; i < 5'000; ++i) {
        const Probe grid = anything(random, grid_number), wild = anything(random, wild_number);
        for (const Probe& probe : {grid, wild, aimed(random)}) {
            if (is_usable(probe)) ++tiers[std::size_t(decide(probe.ray, probe.corners).tier)];
        }
    }
    EXPECT_GT(tiers[0], 1'000);
    EXPECT_GT(tiers[1], 1'000);
    EXPECT_GT(tiers[2], 100);
}

// 600 bits hold every number of these probes without rounding, and nothing here is shared with the oracle:
// Cramer's rule on origin + t d = a + u (b - a) + v (c - a).
class WideNumbers {
  public:
    using Wide = boost::multiprecision::number<
        boost::multiprecision::cpp_bin_float<600, boost::multiprecision::digit_base_2>,
        boost::multiprecision::et_off>;
    using Column = std::array<Wide, 3>;

    explicit WideNumbers(const Probe& probe) {
        const Column ab = column(probe.corners[1], probe.corners[0]),
                     ac = column(probe.corners[2], probe.corners[0]),
                     right = column(probe.ray.origin, probe.corners[0]);
        Column back = column(Vec3{}, probe.ray.direction);
        det = determinant(back, ab, ac);
        t = determinant(right, ab, ac);
        u = determinant(back, right, ac);
        v = determinant(back, ab, right);
        w = det - u - v;
    }
    [[nodiscard]] Meeting meeting() const {
        const std::array<Wide, 3> weights{w, u, v};
        int zeros = 0;
        for (const Wide& weight : weights) {
            if (Wide(weight * det) < 0) return Meeting::Miss;
            zeros += weight == 0 ? 1 : 0;
        }
        return std::array{Meeting::Interior, Meeting::Edge, Meeting::Vertex}[std::size_t(zeros)];
    }
    Wide det, t, u, v, w;

  private:
    static Column column(Vec3 to, Vec3 from) {
        Column result;
        for (std::size_t i = 0; i < 3; ++i) result[i] = Wide(double(to[i])) - Wide(double(from[i]));
        return result;
    }
    static Wide determinant(const Column& a, const Column& b, const Column& c) {
        return a[0] * b[1] * c[2] + b[0] * c[1] * a[2] + c[0] * a[1] * b[2] - c[0] * b[1] * a[2] -
               b[0] * a[1] * c[2] - a[0] * c[1] * b[2];
    }
};

TEST(Oracle, AgreesWithAnEvaluationInSixHundredBits) {
    Random random(43);
    std::array<int, 6> seen{};
    for (int i = 0; i < 20'000; ++i) {
        const Probe probe = i % 4 == 0   ? anything(random, grid_number)
                            : i % 4 == 1 ? anything(random, tame_number)
                                         : aimed(random);
        if (!is_usable(probe)) continue;
        const WideNumbers wide(probe);
        const RationalMeeting exact = meet_exactly(probe.ray, probe.corners);
        ++seen[std::size_t(exact.meeting)];
        if (wide.det == 0) {
            ASSERT_TRUE(exact.meeting != Meeting::Interior && exact.meeting != Meeting::Edge &&
                        exact.meeting != Meeting::Vertex);
            continue;
        }
        ASSERT_EQ(exact.meeting, wide.meeting()) << "probe " << i;
        if (exact.meeting == Meeting::Miss) continue;
        ASSERT_EQ(rounded_to_float(exact.t), WideNumbers::Wide(wide.t / wide.det).convert_to<float>());
        ASSERT_EQ(rounded_to_float(exact.u), WideNumbers::Wide(wide.u / wide.det).convert_to<float>());
        ASSERT_EQ(rounded_to_float(exact.v), WideNumbers::Wide(wide.v / wide.det).convert_to<float>());
    }
    for (const Meeting meeting : {Meeting::Miss, Meeting::Interior, Meeting::Edge, Meeting::Vertex}) {
        EXPECT_GT(seen[std::size_t(meeting)], 100);
    }
}

// The owner is defined by a line moved by (e, e^2), e infinitely small: 2^-200 is small enough for numbers on
// a grid of integers, and large enough to be seen.
TEST(Oracle, OwnerIsPiercedByTheMovedLine) {
    Random random(44);
    int on_border = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Probe probe = anything(random, grid_number);
        if (!is_usable(probe)) continue;
        const std::size_t axis = largest_axis(probe.ray.direction);
        NumberVector<Rational> origin, direction;
        std::array<NumberVector<Rational>, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            origin[k] = Rational(double(probe.ray.origin[k]));
            direction[k] = Rational(double(probe.ray.direction[k]));
            for (std::size_t c = 0; c < 3; ++c) corners[c][k] = Rational(double(probe.corners[c][k]));
        }
        const Rational e(0x1p-200);
        origin[(axis + 1) % 3] += e;
        origin[(axis + 2) % 3] += e * e;
        const bool is_pierced =
            ExactMeeting<Rational>(origin, direction, corners, axis).meeting() == Meeting::Interior;
        const RationalMeeting exact = meet_exactly(probe.ray, probe.corners);
        on_border += exact.meeting == Meeting::Edge || exact.meeting == Meeting::Vertex ? 1 : 0;
        ASSERT_EQ(exact.is_owner, is_pierced) << "probe " << i;
    }
    EXPECT_GT(on_border, 500);
}

TEST(Oracle, NamesTheEdgeAndTheVertex) {
    const Corners corners{Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto down = [](float x, float y) { return Ray{{x, y, 1}, 0, {0, 0, -1}, infinity}; };
    const auto expect = [&](float x, float y, Meeting meeting, int feature) {
        const OracleDecision decision = decide(down(x, y), corners);
        EXPECT_EQ(decision.meeting, meeting) << x << ", " << y;
        EXPECT_EQ(int(decision.feature), feature) << x << ", " << y;
    };
    expect(1, 1, Meeting::Interior, 0);
    expect(2, 0, Meeting::Edge, 0);
    expect(2, 2, Meeting::Edge, 1);
    expect(0, 2, Meeting::Edge, 2);
    expect(0, 0, Meeting::Vertex, 0);
    expect(4, 0, Meeting::Vertex, 1);
    expect(0, 4, Meeting::Vertex, 2);
    expect(3, 3, Meeting::Miss, 0);
}

TEST(Oracle, KnowsWhatIsNeverHit) {
    const Corners corners{Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const OracleDecision in_plane = decide({{-1, 1, 0}, 0, {1, 0, 0}, infinity}, corners);
    EXPECT_EQ(in_plane.meeting, Meeting::EdgeOn);
    EXPECT_FALSE(in_plane.is_hit());
    const Corners line{Vec3{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
    const OracleDecision degenerate = decide({{1, 1, 1}, 0, {0, 0, -1}, infinity}, line);
    EXPECT_EQ(degenerate.meeting, Meeting::Degenerate);
    EXPECT_FALSE(degenerate.is_hit());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(decide({{1, 1, 1}, 0, {0, nan, -1}, infinity}, corners).is_met());
    EXPECT_FALSE(decide({{1, 1, 1}, nan, {0, 0, -1}, infinity}, corners).is_met());
    EXPECT_FALSE(decide({{1, 1, 1}, 0, {0, 0, 0}, infinity}, corners).is_met());
    EXPECT_FALSE(
        decide({{1, 1, 1}, 0, {0, 0, -1}, infinity}, {Vec3{0, 0, infinity}, {4, 0, 0}, {0, 4, 0}}).is_met());
}

TEST(Oracle, TellsTheEndsOfTheIntervalExactly) {
    const Corners corners{Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto is_met = [&](float t_min, float t_max) {
        return decide({{1, 1, 3}, t_min, {0, 0, -3}, t_max}, corners).is_met();
    };
    const float below = std::nextafter(1.0F, 0.0F), above = std::nextafter(1.0F, 2.0F);
    EXPECT_TRUE(is_met(below, above));
    EXPECT_FALSE(is_met(1, above));
    EXPECT_FALSE(is_met(below, 1));
    EXPECT_FALSE(decide({{1, 1, 0}, 0, {0, 0, -3}, 9}, corners).is_met());
    // The largest float, and beyond what rounds to it.
    EXPECT_TRUE(decide({{1, 1, 0x1p64F}, 0, {0, 0, -0x1p-63F}, infinity}, corners).is_met());
    EXPECT_FALSE(decide({{1, 1, 0x1p64F}, 0, {0, 0, -0x1p-64F}, infinity}, corners).is_met());
    EXPECT_TRUE(decide({{1, 1, 0x1p-149F}, 0, {0, 0, -3}, 9}, corners).is_met());
}

TEST(Oracle, RoundsToTheNearestFloat) {
    EXPECT_EQ(rounded_to_float(Rational(1) / 3), 1.0F / 3.0F);
    EXPECT_EQ(rounded_to_float(Rational(1.0 + 0x1p-24)), 1.0F);
    EXPECT_EQ(rounded_to_float(Rational(1.0 + 0x3p-24)), 1.0F + 0x1p-22F);
    EXPECT_EQ(rounded_to_float(Rational(-1.0 - 0x1.8p-24)), -1.0F - 0x1p-23F);
    EXPECT_EQ(rounded_to_float(Rational(0x1p-150)), 0.0F);
    EXPECT_EQ(rounded_to_float(Rational(0x1.1p-150)), 0x1p-149F);
    EXPECT_EQ(rounded_to_float(Rational(0x1p128)), infinity);
    EXPECT_EQ(rounded_to_float(Rational(0x1.ffffffp127)), infinity);
    EXPECT_EQ(rounded_to_float(Rational(0x1.fffffep127)), 0x1.fffffep127F);
}

TEST(Oracle, MeasuresTheMarginInUnitsOfTheShearedCoordinates) {
    const Corners corners{Vec3{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
    const auto margin = [&](float x) {
        const Ray ray{{x, -0.5F, 4}, 0, {0, 0, -1}, infinity};
        return edge_margin_ulps(ray, corners, decide(ray, corners));
    };
    EXPECT_EQ(margin(-1), 0);
    EXPECT_NEAR(margin(-1 + 0x1p-10F), 0x1p13, 0x1p5);  // the far corners are nearly 2 away: ulp 2^-23
    EXPECT_NEAR(margin(-1 - 0x1p-10F), 0x1p12, 0x1p5);  // a little more than 2
}

}  // namespace
}  // namespace rtu::study
