// The methods' templates themselves: in pairs, and what they keep.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "model/methods/single_call-inl.hpp"
#include "model/random.hpp"
#include "model/vec3.hpp"

namespace rtu::model::methods::RTU_TARGET {
namespace {

template <class... Methods, class Check>
void for_each(MethodList<Methods...>, Check check) {
    (check(Methods()), ...);
}

template <class M>
concept HasPair = M::has_pair;

Vector<float> random_vector(RandomStream& random) {
    const float x = random.next(), y = random.next(), z = random.next();
    return {{x, y, z}};
}

struct RayCase {
    Vector<float> origin, direction;
    Interval<float> interval;
};

// At a point of the triangle's plane, mostly in it or beside it, sometimes at a corner or on an edge.
RayCase random_ray(RandomStream& random, const Vector<float>& a, const Vector<float>& b,
                   const Vector<float>& c) {
    const Vector<float> origin = random_vector(random);
    const float s = random.next(), r = random.next(), choice = random.next();
    const float u = choice < 0.1F ? 0 : 1.5F * s - 0.25F, v = choice < 0.05F ? 1 : 1.5F * r - 0.25F;
    const Vector<float> aim = a * (1 - u - v) + b * u + c * v;
    const float t_max = random.next() < 0.2F ? 0.9F : infinity;
    return {origin, aim - origin, {0, t_max}};
}

TEST(MethodTemplates, KeepAsManyBytesAsTheySay) {
    for_each(AllMethods(), []<class M>(M) {
        EXPECT_EQ(sizeof(typename M::template Stored<float>), M::info.stored_bytes) << M::info.name;
    });
}

void expect_same(const Candidate<float>& got, const Distances<float>& hit, const Candidate<float>& expected,
                 const Distances<float>& alone, std::string_view name) {
    ASSERT_EQ(got.is_hit, expected.is_hit) << name;
    if (!got.is_hit) return;
    EXPECT_EQ(hit.t, alone.t) << name;
    EXPECT_EQ(hit.u, alone.u) << name;
    EXPECT_EQ(hit.v, alone.v) << name;
}

template <class M>
void expect_pairs_to_give_what_triangles_give() {
    int first_hits = 0, second_hits = 0, both_hit = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        RandomStream random(12, 0, i);
        const auto a = random_vector(random), b = random_vector(random), c = random_vector(random);
        const auto d = random_vector(random);
        const RayCase ray = i % 2 == 0 ? random_ray(random, a, b, c) : random_ray(random, a, c, d);
        const Axis axis = axis_of_ray(M::info, ray.direction);
        const auto kept = M::prepare(ray.origin, ray.direction, axis);
        const auto got = M::test_pair(kept, ray.interval, M::store_pair(a, b, c, d, axis), axis);
        const auto first = M::test(kept, ray.interval, M::store(a, b, c, axis), axis);
        expect_same(got.first, M::finish(got.first), first, M::finish(first), M::info.name);
        if constexpr (M::info.is_pair_reversed) {
            const auto second = M::test(kept, ray.interval, M::store(a, d, c, axis), axis);
            const auto alone = M::finish(second);
            expect_same(got.second, M::finish(got.second), second, {alone.t, alone.v, alone.u}, M::info.name);
        } else {
            const auto second = M::test(kept, ray.interval, M::store(a, c, d, axis), axis);
            expect_same(got.second, M::finish(got.second), second, M::finish(second), M::info.name);
        }
        first_hits += int(got.first.is_hit);
        second_hits += int(got.second.is_hit);
        both_hit += int(got.first.is_hit && got.second.is_hit);
    }
    EXPECT_GT(first_hits, 300) << M::info.name;
    EXPECT_GT(second_hits, 300) << M::info.name;
    EXPECT_GT(both_hit, 30) << M::info.name;
}

// The second triangle of a pair is tested as (a, c, d), or as (a, d, c).
TEST(MethodTemplates, GiveForAPairWhatItsTrianglesGive) {
    int pairs = 0;
    for_each(AllMethods(), [&]<class M>(M) {
        if constexpr (HasPair<M>) {
            expect_pairs_to_give_what_triangles_give<M>();
            ++pairs;
        }
    });
    EXPECT_EQ(pairs, 7);
}

// What reversing the second triangle costs: nothing but rounding.
template <class M>
void expect_the_second_to_be_near_its_triangle_alone() {
    int hits = 0, differing_decisions = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        RandomStream random(13, 0, i);
        const auto a = random_vector(random), b = random_vector(random), c = random_vector(random);
        const auto d = random_vector(random);
        const RayCase ray = random_ray(random, a, c, d);
        const auto kept = M::prepare(ray.origin, ray.direction, Axis{});
        const auto got = M::test_pair(kept, ray.interval, M::store_pair(a, b, c, d, Axis{}), Axis{}).second;
        const auto alone = M::test(kept, ray.interval, M::store(a, c, d, Axis{}), Axis{});
        if (got.is_hit != alone.is_hit) ++differing_decisions;
        if (!got.is_hit || !alone.is_hit) continue;
        const Distances<float> hit = M::finish(got), expected = M::finish(alone);
        // Rounding grows as the triangle, seen along the ray, shrinks: det against its size.
        if (std::abs(dot(cross(c - a, d - a), ray.direction)) < 0.01F) continue;
        ++hits;
        EXPECT_NEAR(hit.t, expected.t, 2e-5F * expected.t) << M::info.name;
        EXPECT_NEAR(hit.u, expected.u, 2e-5F) << M::info.name;
        EXPECT_NEAR(hit.v, expected.v, 2e-5F) << M::info.name;
    }
    EXPECT_GT(hits, 500) << M::info.name;
    EXPECT_LT(differing_decisions, 200) << M::info.name;  // of about 400 rays aimed exactly at the outline
}

TEST(MethodTemplates, DifferByRoundingWhereThePairReversesATriangle) {
    expect_the_second_to_be_near_its_triangle_alone<MollerTrumboreDeferred>();
    expect_the_second_to_be_near_its_triangle_alone<PluckerTwoCross>();
}

// Whole numbers of 24 bits, whose products integers hold, in pairs so nearly on a line with the origin that
// binary32 products often tie.
TEST(MethodTemplates, DecideAnEdgeExactly) {
    int ties = 0, zeros = 0;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        RandomStream random(15, 0, i);
        const float x1 = std::floor(random.next() * 0x1p23F), y1 = std::floor(random.next() * 0x1p23F);
        const float share = random.next() < 0.2F ? 1.0F : 1 + random.next();
        const float x2 = std::floor(x1 * share), y2 = std::floor(y1 * share);
        const auto exact = std::int64_t(x1) * std::int64_t(y2) - std::int64_t(y1) * std::int64_t(x2);
        const float value = owned_edge_function(x1, y1, x2, y2);
        const float reversed = owned_edge_function(x2, y2, x1, y1);
        ASSERT_EQ(std::signbit(value), exact < 0 || (exact == 0 && std::signbit(value)));
        ASSERT_EQ(value, float(exact));
        if (x1 != x2 || y1 != y2) {
            ASSERT_NE(std::signbit(value), std::signbit(reversed));
        }
        ties += int(x1 * y2 == y1 * x2);
        zeros += int(exact == 0);
    }
    EXPECT_GT(ties - zeros, 300);
    EXPECT_GT(zeros, 300);
}

// Its normal has one component, so that Shevtsov's test takes the shorter path; the rest of the plane's terms
// are zero times something.
TEST(MethodTemplates, TakeShevtsovsAxisOrthogonalPathWithoutChangingTheResult) {
    int hits = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        RandomStream random(14, 0, i);
        auto a = random_vector(random), b = random_vector(random), c = random_vector(random);
        const int k = int(i % 3);
        b.c[k] = c.c[k] = a.c[k];
        const RayCase ray = random_ray(random, a, b, c);
        const auto f = Shevtsov::store(a, b, c, Axis{k});
        EXPECT_EQ(f.n_p, 0);
        EXPECT_EQ(f.n_q, 0);
        auto tilted = f;  // so little that adding it changes nothing
        tilted.n_p = tilted.n_q = 0x1p-120F;
        const auto kept = Shevtsov::prepare(ray.origin, ray.direction, Axis{});
        const auto got = Shevtsov::test(kept, ray.interval, f, Axis{k});
        const auto expected = Shevtsov::test(kept, ray.interval, tilted, Axis{k});
        expect_same(got, Shevtsov::finish(got), expected, Shevtsov::finish(expected), "shevtsov");
        hits += int(got.is_hit);
    }
    EXPECT_GT(hits, 300);
}

}  // namespace
}  // namespace rtu::model::methods::RTU_TARGET
