// The goals of docs/stability.md, at sizes that tests can afford.

#include <gtest/gtest.h>

#include <atomic>

#include "model/parallel.hpp"
#include "study/stability/stability_aims.hpp"
#include "study/stability/stability_run.hpp"

namespace rtu::study {
namespace {

// Sanitizers slow the loops down by a factor of ten and more.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t share = 100;
#else
constexpr std::uint64_t share = 1;
#endif

std::uint64_t failed(const StabilityReport& report) {
    std::uint64_t sum = 0;
    for (const StabilityRow& row : report.rows) {
        EXPECT_GT(row.tally.rays, 0U);
        sum += failures(row.measured, row.tally) + row.tally.parity_errors;
    }
    return sum;
}

StabilityReport report_of(std::vector<std::string> cases, std::vector<std::string> methods,
                          std::uint64_t rays) {
    StabilityOptions options;
    options.cases = std::move(cases);
    options.methods = std::move(methods);
    options.rays = std::max<std::uint64_t>(1, rays / share);
    return run_stability(options);
}

struct Goal {
    const char* mesh;
    std::uint64_t rays;
};
void PrintTo(const Goal& goal, std::ostream* out) { *out << goal.mesh; }

// Ten million rays in all, more where a mesh has few triangles.
class TenMillionRays : public testing::TestWithParam<Goal> {};

TEST_P(TenMillionRays, CrossAClosedMeshOnceWithWoopTopLeft) {
    const std::vector<std::string> names{"woop_top_left"};
    const auto subjects = make_subjects(names);
    const auto first = Subjects(subjects).first(1);
    const auto experiment = watertight_experiment(everywhere(closed_mesh(GetParam().mesh)));
    std::atomic<std::uint64_t> rays = 0, wrong = 0;
    model::for_each_range<std::uint64_t>(GetParam().rays / share, 1024, [&](const auto& range) {
        std::vector<Tally> tallies(1);
        for (std::uint64_t i = range.begin(); i != range.end(); ++i) {
            model::RandomStream random(7, 1, std::uint32_t(i));
            experiment->examine(random, first, tallies);
        }
        rays += tallies[0].rays;
        wrong += tallies[0].leaks + tallies[0].doubles + tallies[0].parity_errors;
    });
    EXPECT_EQ(rays, GetParam().rays / share);
    EXPECT_EQ(wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, TenMillionRays,
                         testing::Values(Goal{"tetrahedron", 3'100'000}, Goal{"flat_tetrahedron", 3'000'000},
                                         Goal{"cube", 2'000'000}, Goal{"fan_16", 900'000},
                                         Goal{"needles", 250'000}, Goal{"fan_128", 120'000},
                                         Goal{"box_grid", 170'000}, Goal{"ball", 150'000},
                                         Goal{"icosphere", 100'000}, Goal{"spiky", 100'000},
                                         Goal{"coral", 100'000}, Goal{"torus", 40'000},
                                         Goal{"fan_1024", 10'000}),
                         [](const auto& test) { return std::string(test.param.mesh); });

TEST(Watertight, WithFusedMultiplyAddsAndInTheMachine) {
    EXPECT_EQ(failed(report_of({"watertight"}, {"woop_top_left", "exact", "rtu", "rtu_traversal"}, 4'000)),
              0U);
}

// What the machine decides, through pairs and tree: the exact owner, nothing else.
TEST(Watertight, TheMachineHitsTheExactOwner) {
    const StabilityReport report =
        report_of({"shared_edge", "shared_vertex", "far_offset", "axis_aligned", "silhouette"},
                  {"rtu", "rtu_traversal"}, 500);
    EXPECT_EQ(failed(report), 0U);
    for (const StabilityRow& row : report.rows) {
        EXPECT_EQ(row.tally.wrong_owners + row.tally.false_hits + row.tally.false_misses, 0U)
            << row.parameter;
    }
}

TEST(Watertight, TheMachineDecidesAMillionTrianglesAsTheOracleDoes) {
    const StabilityReport report = report_of(
        {"ordinary", "grazing", "slivers", "degenerate", "tiny", "huge", "scale_mix"}, {"rtu"}, 20'000);
    EXPECT_EQ(failed(report), 0U);
    std::uint64_t rays = 0;
    for (const StabilityRow& row : report.rows) {
        rays += row.tally.rays;
        EXPECT_EQ(row.tally.wrong_owners, 0U) << row.parameter;
        EXPECT_LE(row.tally.t_ulp.max(), 0.5 + 0x1p-15) << row.parameter;  // the oracle's t is good to 2^-40
    }
    EXPECT_GE(rays * share, 900'000U);
}

// The rules of the DXR specification for degenerate triangles, NaN and infinity.
TEST(Watertight, TheMachineAndWoopTopLeftIgnoreWhatIsNoTriangle) {
    for (const StabilityRow& row : report_of({"not_finite"}, {"rtu", "exact", "woop_top_left"}, 2'000).rows) {
        EXPECT_EQ(row.tally.hits, 0U) << row.method << ", " << row.parameter;
    }
    for (const StabilityRow& row : report_of({"degenerate"}, {"rtu", "exact", "woop_top_left"}, 2'000).rows) {
        if (row.parameter == "nearly on a line" && row.method == "woop_top_left") continue;  // has area
        EXPECT_EQ(row.tally.false_hits, 0U) << row.method << ", " << row.parameter;
    }
}

// With coordinates from 1e-8 to 1e8 in one triangle, only the machine decides well enough for that.
TEST(Watertight, SecondaryRaysThatAreMovedOffLeaveTheSurface) {
    for (const StabilityRow& row : report_of({"reintersect"}, {"rtu", "woop_top_left"}, 30'000).rows) {
        const bool is_moved = row.parameter.find("moved off") != std::string::npos;
        const bool is_mixed = row.parameter.find("10^8") != std::string::npos;
        if (is_moved && is_mixed && row.method != "rtu") continue;
        EXPECT_EQ(row.tally.self_hits == 0, is_moved) << row.method << ", " << row.parameter;
    }
}

TEST(Watertight, NoAcceptedHitIsLostByABox) {
    for (const StabilityRow& row : report_of({"early_out"}, {"rtu"}, 30'000).rows) {
        const bool is_textbook = row.parameter.find("textbook") != std::string::npos;
        if (is_textbook) continue;
        EXPECT_EQ(failures(row.measured, row.tally), 0U) << row.parameter;
    }
}

}  // namespace
}  // namespace rtu::study
