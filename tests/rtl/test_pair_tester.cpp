#include <Vpair_tester_0.h>
#include <Vpair_tester_1.h>
#include <Vpair_tester_2.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "hesitant.hpp"
#include "hit_vectors.hpp"
#include "paths.hpp"
#include "rtl_ref/harness/clock.hpp"
#include "rtl_ref/harness/stream.hpp"
#include "sim/config.hpp"

namespace rtu {
namespace {

using test::HitVector;

template <class Unit>
void drive(Unit& unit, const HitVector& vector) {
    const auto& [pair, ray, tag] = vector.pair;
    static_assert(sizeof unit.leaf_i == sizeof pair);
    std::memcpy(&unit.leaf_i, &pair, sizeof unit.leaf_i);
    std::memcpy(&unit.origin_i, &ray.origin, sizeof unit.origin_i);
    std::memcpy(&unit.direction_i, &ray.direction, sizeof unit.direction_i);
    unit.tag_i = tag;
    unit.kz_i = ray.kz;
    unit.shear_x_i = test::bits_of(ray.shear_x);
    unit.shear_y_i = test::bits_of(ray.shear_y);
    unit.t_min_i = test::bits_of(ray.t_min);
    unit.t_best_i = test::bits_of(vector.t_best());
    unit.has_best_i = vector.best.has_value();
    unit.best_id_i = vector.best ? vector.best->primitive_id : 0;
}

void count_path(test::Paths& paths, const HitVector& vector) {
    const test::HitPath path = test::path_of(test::second_pass_in_model(vector));
    paths.count(path.decided == 0 ? "missed in the first pass"
                : path.better > 0 ? "better hit"
                                  : "no better hit");
    paths.count("both triangles in the second pass", path.decided == 2 ? 1 : 0);
    paths.count("open sides", path.open > 0 ? 1 : 0);
    paths.count("ties", path.ties > 0 ? 1 : 0);
    paths.count("subnormal numbers", test::has_subnormal(vector.pair) ? 1 : 0);
    paths.count("numbers from 2^64 on", test::has_huge(vector.pair) ? 1 : 0);
}

// Sends pairs through a tester, whose results may come in another order: a tag is that of one pair at a time.
// Returns the cycles from accepting the first pair to the last result, or nothing if a result is missing.
template <class Unit, class Draw, class Willing = rtl::AlwaysWilling>
std::optional<std::uint64_t> compare(std::uint64_t count, Draw draw, Willing willing = {},
                                     test::Paths* paths = nullptr) {
    Unit unit;
    std::map<std::uint8_t, HitVector> inside;
    std::uint64_t accepted = 0, retired = 0, cycle = 0, first_accepted = 0, last_progress = 0;
    std::optional<HitVector> offered;
    std::uint8_t tag = 0;
    rtl::reset(unit);
    for (; retired < count; ++cycle) {
        if (!offered && accepted < count && willing.offers()) {
            offered = draw();
            while (inside.contains(++tag)) continue;
            offered->pair.tag = tag;
            drive(unit, *offered);
        }
        unit.valid_i = offered.has_value();
        unit.ready_i = willing.takes();
        rtl::settle(unit);
        if (offered && unit.ready_o) {
            inside.emplace(tag, *offered);
            offered.reset();
            if (accepted++ == 0) first_accepted = cycle;
            last_progress = cycle;
        }
        if (unit.valid_o && unit.ready_i) {
            const auto vector = inside.find(unit.tag_o);
            if (vector == inside.end()) return std::nullopt;
            test::expect_as_model(unit, vector->second);
            if (testing::Test::HasFatalFailure()) return std::nullopt;
            if (paths != nullptr) count_path(*paths, vector->second);
            inside.erase(vector);
            ++retired;
            last_progress = cycle;
        }
        if (cycle - last_progress > 10'000) return std::nullopt;
        rtl::clock_edge(unit);
    }
    return cycle - 1 - first_accepted;
}

template <class Unit>
class PairTester : public testing::Test {};
using Builds = testing::Types<Vpair_tester_0, Vpair_tester_1, Vpair_tester_2>;
struct BuildNames {
    template <class Unit>
    static std::string GetName(int build) {
        return std::array{"single", "dual_independent", "dual_shared"}[std::size_t(build)];
    }
};
TYPED_TEST_SUITE(PairTester, Builds, BuildNames);

TYPED_TEST(PairTester, FindsTheHitsOfTheModel) {
    const std::uint64_t count = test::vector_count(10'000);
    test::Paths paths;
    ASSERT_TRUE(
        compare<TypeParam>(count, test::DrawHit(test::vector_seed(51)), rtl::AlwaysWilling{}, &paths));
    paths.record();
    for (const char* const path : {"missed in the first pass", "better hit", "no better hit", "open sides"})
        EXPECT_GT(paths.times(path), count / 10) << path;
    EXPECT_GT(paths.times("ties"), count / 100);
}

// In cycles, as simulated.
constexpr sim::Config::Rtu::Pair simulated;
constexpr std::uint64_t first_pass = simulated.latency_cycles, queue = 2;
constexpr std::uint64_t hit_units = simulated.hit_units;

// A lone triangle at distance 1, before which the ray ends, or not, or which it misses.
HitVector at_distance_1(float t_max, float origin_x = 0) {
    HitVector vector;
    vector.pair.pair.vertices = {{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}, {-1, 2, 0}}};
    vector.pair.ray = model::make_ray_setup({{origin_x, 0, -1}, 0, {0, 0, 1}, t_max}, {});
    vector.t_max = t_max;
    return vector;
}

TYPED_TEST(PairTester, HasTheDocumentedLatencies) {
    const auto latency = [](const HitVector& vector) {
        return *compare<TypeParam>(1, [&] { return vector; });
    };
    EXPECT_EQ(latency(at_distance_1(2, 9)), first_pass);
    EXPECT_EQ(latency(at_distance_1(1)), first_pass + queue + simulated.reject_cycles);
    EXPECT_EQ(latency(at_distance_1(2)), first_pass + queue + simulated.hit_cycles);
}

// With all hit units taken, the next pair waits for the first one's to be free, a cycle after its result.
TYPED_TEST(PairTester, TakesALoneTriangleACycleAndKeepsSurvivorsWaiting) {
    EXPECT_EQ(compare<TypeParam>(200, [] { return at_distance_1(2, 9); }), 199 + first_pass);
    EXPECT_EQ(compare<TypeParam>(hit_units, [] { return at_distance_1(2); }),
              first_pass + queue + simulated.hit_cycles + hit_units - 1);
    EXPECT_EQ(compare<TypeParam>(hit_units + 1, [] { return at_distance_1(2); }),
              first_pass + queue + simulated.hit_cycles + 1 + simulated.hit_cycles);
}

TYPED_TEST(PairTester, LosesNothingToHesitantNeighbours) {
    EXPECT_TRUE(compare<TypeParam>(1'000, test::DrawHit(52), test::Hesitant{}));
}

}  // namespace
}  // namespace rtu
