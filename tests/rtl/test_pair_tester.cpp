#include <Vpair_tester_0.h>
#include <Vpair_tester_2.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "hesitant.hpp"
#include "hit_vectors.hpp"
#include "rtl_ref/harness/clock.hpp"
#include "rtl_ref/harness/stream.hpp"

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

template <class Unit>
void expect_as_model(const Unit& rtl, const HitVector& vector) {
    const auto expected = test::better_hit_in_model(vector);
    ASSERT_EQ(bool(rtl.found_o), expected.has_value());
    if (!expected) return;
    ASSERT_EQ(rtl.primitive_id_o, expected->primitive_id);
    ASSERT_EQ(rtl.t_o, test::bits_of(expected->t));
    ASSERT_EQ(rtl.u_o, test::bits_of(expected->u));
    ASSERT_EQ(rtl.v_o, test::bits_of(expected->v));
}

// Sends pairs through a tester, whose results may come in another order: a tag is that of one pair at a time.
// Returns the cycles from the first pair to the last result, or nothing if a result is missing.
template <class Unit, class Draw, class Willing = rtl::AlwaysWilling>
std::optional<std::uint64_t> compare(std::uint64_t count, Draw draw, Willing willing = {}) {
    Unit unit;
    std::map<std::uint8_t, HitVector> inside;
    std::uint64_t accepted = 0, retired = 0, cycle = 0, last_progress = 0;
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
            ++accepted;
            last_progress = cycle;
        }
        if (unit.valid_o && unit.ready_i) {
            const auto vector = inside.find(unit.tag_o);
            if (vector == inside.end()) return std::nullopt;
            expect_as_model(unit, vector->second);
            if (testing::Test::HasFatalFailure()) return std::nullopt;
            inside.erase(vector);
            ++retired;
            last_progress = cycle;
        }
        if (cycle - last_progress > 10'000) return std::nullopt;
        rtl::clock_edge(unit);
    }
    return cycle - 1;
}

template <class Unit>
class PairTester : public testing::Test {};
using Builds = testing::Types<Vpair_tester_0, Vpair_tester_2>;
struct BuildNames {
    template <class Unit>
    static std::string GetName(int build) {
        return std::array{"single", "dual_shared"}[std::size_t(build)];
    }
};
TYPED_TEST_SUITE(PairTester, Builds, BuildNames);

TYPED_TEST(PairTester, FindsTheHitsOfTheModel) {
    EXPECT_TRUE(compare<TypeParam>(test::vector_count(10'000), test::DrawHit(51)));
}

TYPED_TEST(PairTester, LosesNothingToHesitantNeighbours) {
    EXPECT_TRUE(compare<TypeParam>(2'000, test::DrawHit(52), test::Hesitant{}));
}

}  // namespace
}  // namespace rtu
