#include <Vexact_side.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "hesitant.hpp"
#include "model/exact_triangle.hpp"
#include "model/ray_setup.hpp"
#include "rtl_ref/harness/stream.hpp"
#include "vectors.hpp"

namespace rtu {
namespace {

using model::Side;
using model::Vec3;
using test::RandomBits;

struct Edge {
    model::Line line;
    Vec3 p, q;
    std::uint8_t tag = 0;
};

Side side_in_model(const Edge& edge) {
    const model::ExactTriangle triangle(edge.line, {edge.p, edge.q, edge.p});
    return triangle.side(0, triangle.edge_function(0));
}

// Numbers of all sizes; on a small grid, where many volumes and ties are zero; edges that the line meets but
// for the rounding to binary32; and edges with both ends on the line or at one place.
class DrawEdge {
  public:
    explicit DrawEdge(std::uint64_t seed) : random_(seed) {}
    Edge operator()() {
        Edge edge;
        switch (random_.below(4)) {
            case 0:
                edge = {{wild(), wild()}, wild(), wild()};
                break;
            case 1:
                edge = {{on_grid(4), on_grid(2)}, on_grid(4), on_grid(4)};
                break;
            case 2:
                edge = {{on_grid(1), on_grid(1)}, on_grid(1), on_grid(1)};
                break;
            default:
                edge = aimed();
        }
        if (random_.one_in(16)) edge.q = edge.p;
        if (random_.one_in(16)) edge.q = edge.p + edge.line.direction;
        if (!model::is_finite(edge.q)) edge.q = edge.p;
        if (edge.line.direction == Vec3{}) edge.line.direction.x = 1;
        edge.line.axis = model::make_ray_setup({{}, 0, edge.line.direction, 1}, {}).kz;
        edge.tag = std::uint8_t(random_.bits());
        return edge;
    }

  private:
    float wild_number() {
        while (true) {
            const float x = random_.one_in(6) ? random_.special() : random_.any();
            if (std::isfinite(x)) return x;
        }
    }
    Vec3 wild() { return {wild_number(), wild_number(), wild_number()}; }
    Vec3 on_grid(int size) {
        const auto number = [&] { return float(int(random_.below(std::uint32_t(2 * size + 1))) - size); };
        return {number(), number(), number()};
    }
    Edge aimed() {
        const float offset = std::ldexp(1.0F, int(random_.below(24)));
        const Vec3 far{offset, -offset, offset};
        const Vec3 p = far + random_.point(-1, 1), q = far + random_.point(-1, 1);
        const Vec3 origin = random_.point(-4, 4);
        return {{origin, p + (q - p) * random_.uniform(0, 1) - origin}, p, q};
    }
    RandomBits random_;
};

void drive(Vexact_side& unit, const Edge& edge) {
    unit.tag_i = edge.tag;
    unit.kz_i = edge.line.axis;
    std::memcpy(&unit.origin_i, &edge.line.origin, sizeof unit.origin_i);
    std::memcpy(&unit.direction_i, &edge.line.direction, sizeof unit.direction_i);
    std::memcpy(&unit.p_i, &edge.p, sizeof unit.p_i);
    std::memcpy(&unit.q_i, &edge.q, sizeof unit.q_i);
}

struct Tally {
    std::optional<rtl::StreamCycles> cycles;
    std::array<std::uint64_t, 3> sides{};  // negative, neither, positive
};

template <class Draw, class Willing = rtl::AlwaysWilling>
Tally compare(std::uint64_t count, Draw draw, Willing willing = {}) {
    Vexact_side unit;
    Tally tally;
    const auto check = [&](const Vexact_side& rtl, const Edge& edge) {
        if (testing::Test::HasFatalFailure()) return;
        const int expected = int(side_in_model(edge));
        ++tally.sides[std::uint32_t(expected + 1)];
        ASSERT_EQ(rtl.tag_o, edge.tag);
        ASSERT_EQ(int(rtl.is_positive_o) - int(rtl.is_negative_o), expected);
    };
    tally.cycles = rtl::run_stream(unit, count, draw, drive, check, willing);
    return tally;
}

TEST(ExactSide, IsThatOfTheModel) {
    const std::uint64_t count = test::vector_count(1'000'000);
    const Tally tally = compare(count, DrawEdge(31));
    ASSERT_TRUE(tally.cycles);
    for (const std::uint64_t side : tally.sides) EXPECT_GT(side, count / 50);
}

// One cycle to start, eighteen products, three until the last is in the sum and eight to settle; a tie takes
// four products, three and eight more.
TEST(ExactSide, HasTheDocumentedLatency) {
    const Edge clear{{{0, 0, -1}, {0, 0, 1}, 2}, {1, -1, 0}, {1, 1, 0}};
    const Edge tied{{{0, 0, -1}, {0, 0, 1}, 2}, {0, -1, 0}, {0, 1, 0}};
    const Edge tied_twice{{{0, 0, -1}, {0, 0, 1}, 2}, {-1, 0, 0}, {1, 0, 0}};
    const auto latency = [](const Edge& edge) {
        return compare(1, [&] { return edge; }).cycles->first_result;
    };
    EXPECT_EQ(latency(clear), 30U);
    EXPECT_EQ(latency(tied), 30U + 15U);
    EXPECT_EQ(latency(tied_twice), 30U + 30U);
}

TEST(ExactSide, LosesNothingToHesitantNeighbours) {
    EXPECT_TRUE(compare(2'000, DrawEdge(32), test::Hesitant{}).cycles);
}

}  // namespace
}  // namespace rtu
