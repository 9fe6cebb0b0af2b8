#include <Vbox_tester_2.h>
#include <Vbox_tester_4.h>
#include <Vbox_tester_6.h>
#include <Vbox_tester_8.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "box_vectors.hpp"
#include "hesitant.hpp"
#include "paths.hpp"
#include "rtl_ref/harness/stream.hpp"
#include "sim/config.hpp"

namespace rtu {
namespace {

using model::Vec3;
using test::BoxVector;
using test::RandomBits;

constexpr float infinity = std::numeric_limits<float>::infinity();

template <class Top, std::uint32_t ChildCount>
struct Build {
    using Unit = Top;
    static constexpr std::uint32_t width = ChildCount;
};

// How a node and a ray are drawn.
enum class Kind : std::uint8_t { Scene, AxisParallel, Grid, AnyBits, Special, Extreme };
constexpr std::array kinds{Kind::Scene,   Kind::AxisParallel, Kind::Grid,
                           Kind::AnyBits, Kind::Special,      Kind::Extreme};

template <std::uint32_t Width>
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}

    BoxVector<Width> operator()() {
        const Kind kind = kinds[random_.below(kinds.size())];
        BoxVector<Width> vector;
        vector.tag = std::uint8_t(random_.bits());
        vector.node.child_count = random_.one_in(3) ? random_.below(Width + 1) : Width;
        if (kind == Kind::AnyBits || kind == Kind::Special || kind == Kind::Extreme) {
            draw_numbers(kind, vector);
        } else {
            draw_geometry(kind, vector);
        }
        return vector;
    }

  private:
    float number(Kind kind) {
        if (kind == Kind::AnyBits) return random_.any();
        if (kind == Kind::Special) return random_.special();
        return random_.one_in(2) ? random_.of_exponent(0, 25) : random_.of_exponent(110, 145);
    }
    float not_nan(Kind kind) {
        const float x = number(kind);
        return x == x ? x : 0.0F;
    }
    Vec3 numbers(Kind kind) { return {number(kind), number(kind), number(kind)}; }

    // Every input on its own: nothing of what relates them in a machine.
    void draw_numbers(Kind kind, BoxVector<Width>& vector) {
        for (auto& side : vector.node.planes) {
            for (auto& axis : side) {
                for (float& plane : axis) plane = number(kind);
            }
        }
        vector.ray.origin_near = numbers(kind);
        vector.ray.origin_far = random_.one_in(2) ? vector.ray.origin_near : numbers(kind);
        vector.ray.inv_direction = numbers(kind);
        for (std::uint32_t& side : vector.ray.entry_side) side = random_.below(2);
        vector.ray.t_min = not_nan(kind);
        vector.t_end = not_nan(kind);
    }

    float coordinate(Kind kind) {
        return kind == Kind::Grid ? float(int(random_.below(9)) - 4) : random_.uniform(-1, 1);
    }
    Vec3 point(Kind kind) { return {coordinate(kind), coordinate(kind), coordinate(kind)}; }

    // Boxes in a scene and a ray through it, set up as the machine does it.
    void draw_geometry(Kind kind, BoxVector<Width>& vector) {
        for (std::uint32_t i = 0; i < Width; ++i) {
            model::Aabb box;
            if (i < vector.node.child_count || random_.one_in(2)) {
                box.extend(point(kind));
                box.extend(point(kind));
            }
            if (i > 0 && random_.one_in(8)) box = vector.node.box(i - 1);
            vector.node.set_box(i, box);
        }
        const float size = kind == Kind::Grid ? 4.0F : 1.0F;
        model::Ray ray{point(kind) * (random_.one_in(2) ? 1.0F : 3.0F), 0, point(kind), infinity};
        if (kind == Kind::AxisParallel) draw_parallel(vector.node, ray);
        if (ray.direction == Vec3{}) ray.direction.y = -1;
        vector.ray = model::make_ray_setup(ray, {{-size, -size, -size}, {size, size, size}});
        vector.ray.t_min = random_.one_in(4) ? random_.uniform(-1, 1) : 0.0F;
        vector.t_end = random_.one_in(2) ? infinity : random_.uniform(0, 4);
        if (random_.one_in(4)) {  // onto a plane, where a parallel ray gives 0 * infinity
            const std::size_t axis = random_.below(3);
            vector.ray.origin_near[axis] = vector.node.planes[random_.below(2)][axis][random_.below(Width)];
        }
    }
    void draw_parallel(const model::Node<Width>& node, model::Ray& ray) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (random_.one_in(2)) ray.direction[axis] = random_.one_in(2) ? 0.0F : -0.0F;
            if (random_.one_in(6)) ray.direction[axis] = 0x1p-140F;  // whose reciprocal is taken out
            const float plane = node.planes[random_.below(2)][axis][random_.below(Width)];
            if (random_.one_in(2) && std::isfinite(plane)) ray.origin[axis] = plane;
        }
    }

    RandomBits random_;
};

template <class B>
class BoxTester : public testing::Test {};
using Builds = testing::Types<Build<Vbox_tester_2, 2>, Build<Vbox_tester_4, 4>, Build<Vbox_tester_6, 6>,
                              Build<Vbox_tester_8, 8>>;
struct BuildNames {
    template <class B>
    static std::string GetName(int) {
        return std::to_string(B::width);
    }
};
TYPED_TEST_SUITE(BoxTester, Builds, BuildNames);

struct BoxTally {
    std::uint64_t none = 0, some = 0, all = 0;    // children met, of those that there are
    std::uint64_t ties = 0;                       // two that are met at one distance
    std::uint64_t not_finite = 0, subnormal = 0;  // a plane or a number of the ray

    void record() const {
        test::Paths paths;
        paths.count("no child met", none);
        paths.count("some met", some);
        paths.count("all met", all);
        paths.count("two at one distance", ties);
        paths.count("infinities or NaN", not_finite);
        paths.count("subnormal numbers", subnormal);
        paths.record();
    }
};

template <std::uint32_t Width>
void count_path(BoxTally& tally, const BoxVector<Width>& vector, std::uint32_t met,
                const std::array<std::uint32_t, Width>& t_near) {
    ++(met == 0 ? tally.none : met == vector.node.child_count ? tally.all : tally.some);
    bool has_tie = false, is_not_finite = false, has_subnormal = false;
    for (std::uint32_t i = 1; i < met; ++i) has_tie |= t_near[i] == t_near[i - 1];
    const auto look_at = [&](float x) {
        is_not_finite |= !std::isfinite(x);
        has_subnormal |= std::fpclassify(x) == FP_SUBNORMAL;
    };
    const auto& ray = vector.ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const auto& side : vector.node.planes) std::ranges::for_each(side[axis], look_at);
        for (const Vec3& v : {ray.origin_near, ray.origin_far, ray.inv_direction}) look_at(v[axis]);
    }
    tally.ties += has_tie;
    tally.not_finite += is_not_finite;
    tally.subnormal += has_subnormal;
}

template <class B, class Willing = rtl::AlwaysWilling>
std::optional<rtl::StreamCycles> compare(std::uint64_t count, Willing willing = {},
                                         BoxTally* tally = nullptr) {
    constexpr std::uint32_t width = B::width;
    typename B::Unit unit;
    Draw<width> draw(test::vector_seed(width));
    test::BoxReference<width> reference;
    const auto check = [&](const auto& rtl, const BoxVector<width>& vector, std::uint64_t /*cycles*/) {
        if (testing::Test::HasFatalFailure()) return;
        test::expect_as_model(rtl, vector, reference);
        std::array<std::uint32_t, width> t_near{};
        std::memcpy(&t_near, &rtl.t_near_o, sizeof t_near);
        if (tally != nullptr) count_path<width>(*tally, vector, rtl.count_o, t_near);
    };
    return rtl::run_stream(
        unit, count, [&] { return draw(); }, [](auto& rtl, const auto& vector) { test::drive(rtl, vector); },
        check, willing);
}

TYPED_TEST(BoxTester, MeetsTheChildrenOfTheModelInItsOrderOneNodeACycle) {
    const std::uint64_t count = test::vector_count(1'000'000);
    BoxTally tally;
    const auto cycles = compare<TypeParam>(count, rtl::AlwaysWilling{}, &tally);
    ASSERT_TRUE(cycles);
    tally.record();
    for (const std::uint64_t times : {tally.none, tally.some, tally.not_finite, tally.subnormal})
        EXPECT_GT(times, count / 50);
    // The more children, the fewer nodes of which all are met; the fewer, the fewer that are met at one
    // place.
    for (const std::uint64_t times : {tally.all, tally.ties}) EXPECT_GT(times, count / 500);
    EXPECT_EQ(cycles->total, cycles->first_result + count - 1);
}

TYPED_TEST(BoxTester, HasTheLatencyOfTheDefaultMachine) {
    const auto cycles = compare<TypeParam>(1);
    ASSERT_TRUE(cycles);
    EXPECT_EQ(cycles->first_result, sim::Config{}.rtu.box.latency_cycles);
}

TYPED_TEST(BoxTester, LosesNothingToHesitantNeighbours) {
    EXPECT_TRUE(compare<TypeParam>(5'000, test::Hesitant{}));
}

}  // namespace
}  // namespace rtu
