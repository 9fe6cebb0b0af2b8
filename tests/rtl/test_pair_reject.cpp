#include <Vpair_reject_0.h>
#include <Vpair_reject_1.h>
#include <Vpair_reject_2.h>
#include <gtest/gtest.h>

#include <array>

#include "hesitant.hpp"
#include "hit_vectors.hpp"
#include "pair_vectors.hpp"
#include "paths.hpp"
#include "rtl_ref/harness/stream.hpp"
#include "sim/config.hpp"

namespace rtu {
namespace {

using sim::PairMode;
using test::PairVector;

template <class Top, PairMode Mode>
struct Build {
    using Unit = Top;
    static constexpr PairMode mode = Mode;
};

template <class B>
class PairReject : public testing::Test {};
using Builds =
    testing::Types<Build<Vpair_reject_0, PairMode::Single>, Build<Vpair_reject_1, PairMode::DualIndependent>,
                   Build<Vpair_reject_2, PairMode::DualShared>>;
struct BuildNames {
    template <class B>
    static std::string GetName(int) {
        constexpr std::array names{"single", "dual_independent", "dual_shared"};
        return names[std::size_t(B::mode)];
    }
};
TYPED_TEST_SUITE(PairReject, Builds, BuildNames);

struct Tally {
    std::optional<rtl::StreamCycles> cycles;
    std::array<std::uint64_t, 4> outcomes{};  // by the triangles that go on
    std::uint64_t triangles = 0;
    std::uint64_t inside = 0;  // triangles that need no exact side
};

template <class B, class Draw, class Willing = rtl::AlwaysWilling>
Tally compare(std::uint64_t count, Draw draw, Willing willing = {}) {
    typename B::Unit unit;
    Tally tally;
    const auto check = [&](const auto& rtl, const PairVector& vector, std::uint64_t /*cycles*/) {
        if (testing::Test::HasFatalFailure()) return;
        const std::uint32_t expected = test::goes_on_in_model(vector);
        ++tally.outcomes[expected];
        tally.triangles += vector.pair.has_second() ? 2 : 1;
        ASSERT_EQ(rtl.tag_o, vector.tag);
        ASSERT_EQ(rtl.goes_on_o, expected);
        for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
            if ((rtl.is_inside_o >> triangle & 1U) == 0) continue;
            ASSERT_TRUE(test::is_inside_exactly(vector, triangle));
            ++tally.inside;
        }
    };
    tally.cycles = rtl::run_stream(
        unit, count, draw, [](auto& rtl, const auto& vector) { test::drive(rtl, vector); }, check, willing);
    return tally;
}

TYPED_TEST(PairReject, LetsThroughWhatTheModelLetsThroughAtItsRate) {
    const std::uint64_t count = test::vector_count(1'000'000);
    const Tally tally = compare<TypeParam>(count, test::DrawPair(test::vector_seed(21)));
    ASSERT_TRUE(tally.cycles);
    test::Paths paths;
    paths.count("nothing left", tally.outcomes[0]);
    paths.count("one triangle left", tally.outcomes[1] + tally.outcomes[2]);
    paths.count("both left", tally.outcomes[3]);
    paths.count("triangles inside", tally.inside);
    paths.record();
    for (const std::uint64_t outcome : tally.outcomes) EXPECT_GT(outcome, count / 50);
    EXPECT_GT(tally.inside, count / 50);
    const std::uint64_t issues = TypeParam::mode == PairMode::Single ? tally.triangles : count;
    EXPECT_LE(tally.cycles->total - (issues - 1), tally.cycles->first_result);
    EXPECT_GE(tally.cycles->total - (issues - 1), tally.cycles->first_result - 1);
}

// Of a lone triangle, issue to result.
TYPED_TEST(PairReject, HasTheDocumentedLatency) {
    test::DrawPair draw(22);
    const Tally tally = compare<TypeParam>(1, [&] {
        PairVector vector = draw();
        while (vector.pair.has_second()) vector = draw();
        return vector;
    });
    ASSERT_TRUE(tally.cycles);
    EXPECT_EQ(tally.cycles->first_result, sim::Config{}.rtu.pair.latency_cycles);
}

TYPED_TEST(PairReject, LosesNothingToHesitantNeighbours) {
    EXPECT_TRUE(compare<TypeParam>(5'000, test::DrawPair(23), test::Hesitant{}).cycles);
}

}  // namespace
}  // namespace rtu
