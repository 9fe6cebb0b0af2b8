#include <Vhit_unit.h>
#include <gtest/gtest.h>

#include "hesitant.hpp"
#include "hit_vectors.hpp"
#include "paths.hpp"
#include "rtl_ref/harness/stream.hpp"
#include "sim/config.hpp"

namespace rtu {
namespace {

using test::SecondPass;

// Of the pairs drawn, those that the first pass lets through.
class DrawSecondPass {
  public:
    explicit DrawSecondPass(std::uint64_t seed) : draw_(seed), random_(seed) {}
    SecondPass operator()() {
        SecondPass vector;
        while (vector.goes_on == 0) {
            vector.hit = draw_();
            vector.goes_on = std::uint8_t(test::goes_on_in_model(vector.hit.pair));
        }
        for (std::uint32_t i = 0; i < 2; ++i) {
            const bool knows = (vector.goes_on >> i & 1U) != 0 && !random_.one_in(3);
            if (knows && test::is_inside_exactly(vector.hit.pair, i))
                vector.is_inside = std::uint8_t(vector.is_inside | 1U << i);
        }
        return vector;
    }

  private:
    test::DrawHit draw_;
    test::RandomBits random_;
};

// What a pair took beyond the documented cycles of its path is midpoints. Returns how many, one a triangle's
// t, u and v at most.
std::uint64_t midpoints_of(const test::HitPath& path, std::uint64_t cycles) {
    EXPECT_GE(cycles, path.cycles);
    const std::uint64_t more = cycles - path.cycles, midpoints = more / test::midpoint_cycles;
    EXPECT_LE(midpoints, 3 * path.decided);
    EXPECT_LE(more - midpoints * test::midpoint_cycles, std::min<std::uint64_t>(midpoints, path.better));
    return midpoints;
}

void count_path(test::Paths& paths, const SecondPass& vector, std::uint64_t cycles) {
    const test::HitPath path = test::path_of(vector);
    const std::uint64_t midpoints = midpoints_of(path, cycles);
    paths.count(path.better > 0 ? "better hit" : "no better hit");
    paths.count("both triangles", path.decided == 2 ? 1 : 0);
    paths.count("open sides", path.open > 0 ? 1 : 0);
    paths.count("ties", path.ties > 0 ? 1 : 0);
    paths.count("midpoints", midpoints > 0 ? 1 : 0);
    paths.count("subnormal numbers", test::has_subnormal(vector.hit.pair) ? 1 : 0);
    paths.count("numbers from 2^64 on", test::has_huge(vector.hit.pair) ? 1 : 0);
}

template <class Draw, class Willing = rtl::AlwaysWilling>
std::optional<rtl::StreamCycles> compare(std::uint64_t count, Draw draw, Willing willing = {},
                                         test::Paths* paths = nullptr) {
    Vhit_unit unit;
    const auto check = [&](const Vhit_unit& rtl, const SecondPass& vector, std::uint64_t cycles) {
        if (testing::Test::HasFailure()) return;
        ASSERT_EQ(rtl.tag_o, vector.hit.pair.tag);
        test::expect_as_model(rtl, vector.hit);
        if (paths != nullptr) count_path(*paths, vector, cycles);
    };
    return rtl::run_stream(
        unit, count, draw, [](auto& rtl, const auto& vector) { test::drive(rtl, vector); }, check, willing);
}

TEST(HitUnit, FindsTheHitsOfTheModelInTheDocumentedCycles) {
    const std::uint64_t count = test::vector_count(60'000);
    test::Paths paths;
    ASSERT_TRUE(compare(count, DrawSecondPass(test::vector_seed(41)), rtl::AlwaysWilling{}, &paths));
    paths.record();
    EXPECT_EQ(paths.times("better hit") + paths.times("no better hit"), count);
    for (const char* const path : {"better hit", "no better hit", "both triangles", "open sides"})
        EXPECT_GT(paths.times(path), count / 10) << path;
    for (const char* const path : {"ties", "midpoints", "subnormal numbers", "numbers from 2^64 on"})
        EXPECT_GT(paths.times(path), count / 100) << path;
    EXPECT_LT(paths.times("midpoints"), count / 20);  // or the leading bits settle less than they should
}

// A lone triangle across a ray along z. The first pass knows the sides of those that the ray does not meet at
// an edge.
SecondPass across(const std::array<model::Vec3, 3>& corners, model::Vec3 origin, float direction = 1) {
    SecondPass vector;
    auto& [pair, ray, tag] = vector.hit.pair;
    pair.vertices = {corners[0], corners[1], corners[2], corners[2]};
    ray = model::make_ray_setup({origin, 0, {0, 0, direction}, 100}, {});
    vector.hit.t_max = 100;
    vector.goes_on = vector.is_inside = 1;
    return vector;
}

std::uint64_t latency(const SecondPass& vector) {
    return compare(1, [&] { return vector; })->first_result;
}

constexpr std::array<model::Vec3, 3> plain{{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}}};
// In cycles: what the simulator charges, and what is so rare that it does not.
constexpr sim::Config::Rtu::Pair simulated;
constexpr std::uint64_t not_better = simulated.reject_cycles, better = simulated.hit_cycles;
constexpr std::uint64_t sides = simulated.side_cycles, tie = 37, midpoint = test::midpoint_cycles;

TEST(HitUnit, TakesTheDocumentedCyclesForATriangle) {
    SecondPass vector = across(plain, {0, 0, -1});
    EXPECT_EQ(latency(vector), better);
    vector.hit.t_max = 1;
    EXPECT_EQ(latency(vector), not_better);
    EXPECT_EQ(latency(across(plain, {0, 0, 1})), not_better);
}

// (x, -y, z) are the corners of the pair's second triangle, which the ray meets as well.
TEST(HitUnit, TakesASecondTriangleAfterTheFirst) {
    SecondPass vector = across(plain, {0, 0, -1});
    vector.hit.pair.pair.vertices = {{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}, {2, -1, -0.5F}}};
    vector.hit.pair.pair.flags = 1;
    vector.goes_on = vector.is_inside = 3;
    EXPECT_EQ(latency(vector), 2 * better);
    std::swap(vector.hit.pair.pair.vertices[1], vector.hit.pair.pair.vertices[3]);
    EXPECT_EQ(latency(vector), better + not_better);
    vector.hit.t_max = 0.1F;
    EXPECT_EQ(latency(vector), 2 * not_better);
}

TEST(HitUnit, TakesTheDocumentedCyclesForSides) {
    const auto open = [](model::Vec3 origin) {
        SecondPass vector = across(plain, origin);
        vector.is_inside = 0;
        return vector;
    };
    const auto after_sides = [](const SecondPass& vector) {
        return test::better_hit_in_model(vector.hit) ? better : 1;
    };
    EXPECT_EQ(latency(open({0, 0, -1})), sides + better);
    EXPECT_EQ(latency(open({2, 2, -1})), sides + 1);
    const SecondPass tied = open({-1, 0, -1}), tied_twice = open({0, -1, -1});
    EXPECT_EQ(latency(tied), sides + tie + after_sides(tied));
    EXPECT_EQ(latency(tied_twice), sides + 2 * tie + after_sides(tied_twice));
}

// At a distance of 2 + 2^-23, half way between two numbers; and 2.5 * 2^-23 beyond half of the way to a
// corner.
TEST(HitUnit, TakesTheDocumentedCyclesForAMidpoint) {
    const float z = 1 + 0x1p-23F, side = 1 + 0x1p-23F, other = 0x1.234567p1F;
    EXPECT_EQ(latency(across({{{-1.3F, -1.2F, z}, {2.3F, -1.1F, z}, {-1.7F, 2.2F, z}}}, {0, 0, -1})),
              midpoint + better);
    EXPECT_EQ(latency(across({{{-side, -1.1F, 0}, {2 - side, -1.1F, 0}, {-side, other, 0}}},
                             {0x3p-24F, -1, -1}, 1.3F)),
              midpoint + better);
    EXPECT_EQ(latency(across({{{-1.1F, -side, 0}, {other, -side, 0}, {-1.1F, 2 - side, 0}}},
                             {-1, 0x3p-24F, -1}, 1.3F)),
              midpoint + 1 + better);
}

TEST(HitUnit, LosesNothingToHesitantNeighbours) {
    EXPECT_TRUE(compare(2'000, DrawSecondPass(42), test::Hesitant{}));
}

}  // namespace
}  // namespace rtu
