#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <map>

#include "model/error.hpp"
#include "model/vec3.hpp"
#include "study/stability/stability_aims.hpp"
#include "study/stability/stability_metamorphic.hpp"
#include "study/stability/stability_probes.hpp"
#include "study/stability/stability_run.hpp"

namespace rtu::study {
namespace {

using model::RandomStream;
using model::Ray;
using model::Vec3;
using model::methods::Corners;
using model::methods::TestHit;

using model::infinity;

// A method that is made up: the oracle's answer, changed.
class Imagined : public Subject {
  public:
    using Change = std::function<std::optional<TestHit>(const OracleDecision&)>;
    explicit Imagined(Change change) : Subject("imagined", "off"), change_(std::move(change)) {}
    [[nodiscard]] std::optional<TestHit> test(const Ray& ray, const Corners& corners) const override {
        return change_(decide(ray, corners));
    }
    [[nodiscard]] std::vector<SurfaceHit> all_hits(const Ray& ray, const Surface& surface) const override {
        std::vector<SurfaceHit> hits;
        for (std::uint32_t id = 0; id < surface.corners.size(); ++id) {
            if (const auto hit = test(ray, surface.corners[id])) hits.push_back({id, *hit});
        }
        return hits;
    }

  private:
    Change change_;
};

TestHit rounded(const OracleDecision& exact) { return {float(exact.t), float(exact.u), float(exact.v)}; }
std::optional<TestHit> owner(const OracleDecision& exact) {
    return exact.is_hit() ? std::optional(rounded(exact)) : std::nullopt;
}
std::optional<TestHit> inclusive(const OracleDecision& exact) {
    return exact.is_met() ? std::optional(rounded(exact)) : std::nullopt;
}
std::optional<TestHit> exclusive(const OracleDecision& exact) {
    return exact.is_inside() ? std::optional(rounded(exact)) : std::nullopt;
}

Tally tally_of(const Experiment& experiment, Imagined::Change change, std::uint32_t rays = 500) {
    std::vector<std::unique_ptr<Subject>> subjects;
    subjects.push_back(std::make_unique<Imagined>(std::move(change)));
    std::vector<Tally> tallies(1);
    for (std::uint32_t i = 0; i < rays; ++i) {
        RandomStream random(1, 77, i);
        experiment.examine(random, subjects, tallies);
    }
    return tallies[0];
}

class ClosedMeshes : public testing::TestWithParam<ClosedMesh> {};
}  // namespace
static void PrintTo(const ClosedMesh& mesh, std::ostream* out) { *out << mesh.name; }
namespace {

TEST_P(ClosedMeshes, AreClosedAndWoundOutwards) {
    const model::TriangleMesh mesh = GetParam().make();
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double volume = 0;
    for (const model::Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
        volume += double(dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])));
        ASSERT_FALSE(is_degenerate(mesh, t));
    }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ((edges.count({edge.second, edge.first})), 1U);
    }
    EXPECT_GT(volume, 0);
}

TEST_P(ClosedMeshes, AreLeftAnOddNumberOfTimesFromInside) {
    const ClosedMesh& mesh = GetParam();
    const auto surface = placed_surface(mesh.make(), {});
    for (const Aim aim : {Aim::Random, Aim::Edge, Aim::Vertex}) {
        const DrawRay draw = rays_at(surface, mesh.inner_radius, {}, aim);
        for (std::uint32_t i = 0; i < 100; ++i) {
            RandomStream random(2, 1, i);
            const Ray ray = draw(random);
            std::size_t crossings = 0;
            for (const Corners& corners : surface->corners)
                crossings += decide(ray, corners).is_hit() ? 1 : 0;
            ASSERT_EQ(crossings % 2, mesh.inner_radius > 0 ? 1U : 0U) << "ray " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, ClosedMeshes, testing::ValuesIn(closed_meshes().begin(), closed_meshes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ErrorHistogram, HasTheQuantilesOfItsValues) {
    ErrorHistogram errors;
    EXPECT_FALSE(errors.quantile(0.5).has_value());
    for (int i = 1; i <= 1000; ++i) errors.add(double(i) * 0.01);
    EXPECT_EQ(errors.count(), 1000U);
    EXPECT_EQ(errors.max(), 10.0);
    EXPECT_NEAR(*errors.quantile(0.5), 5.0, 0.08);
    EXPECT_GE(*errors.quantile(0.5), 5.0);
    EXPECT_NEAR(*errors.quantile(0.99), 9.9, 0.16);
    EXPECT_EQ(*errors.quantile(1), 10.0);
    ErrorHistogram zeros;
    zeros.add(0);
    EXPECT_EQ(*zeros.quantile(0.5), 0.0);
    zeros += errors;
    EXPECT_EQ(zeros.count(), 1001U);
    EXPECT_EQ(zeros.max(), 10.0);
}

// The textbook's slab test loses boxes, a subnormal flushed to zero is another number, and an end that equals
// the rounded t does not end a hit at the exact one.
bool is_beyond_exact_answers(const StabilitySetting& setting) {
    for (const char* name : {"textbook", "flushed", "t_max shrinks"}) {
        if (setting.parameter.find(name) != std::string::npos) return true;
    }
    return false;
}

TEST(Stability, FindsNoFaultWithExactAnswers) {
    for (const StabilityCase& one : stability_cases()) {
        if (one.name == "large_mesh" || one.name == "reintersect" || one.name == "watertight") continue;
        for (const StabilitySetting& setting : one.settings) {
            if (is_beyond_exact_answers(setting)) continue;
            const auto experiment = setting.make();
            const Tally tally = tally_of(*experiment, owner, experiment->triangles_per_ray() > 300 ? 4 : 40);
            EXPECT_EQ(failures(experiment->measured(), tally), 0U) << one.name << ", " << setting.parameter;
            EXPECT_EQ(tally.wrong_owners, 0U) << one.name << ", " << setting.parameter;
            EXPECT_LE(tally.t_ulp.max(), 0.5) << one.name << ", " << setting.parameter;
        }
    }
}

TEST(Stability, CountsLeaksDoublesAndParityByRay) {
    const auto surface = placed_surface(box_grid(4), {});
    const auto at_vertices = surface_experiment(surface, rays_at(surface, 0, {}, Aim::AxisVertex, 4));
    const Tally owned = tally_of(*at_vertices, owner);
    EXPECT_EQ(owned.rays, 500U);
    EXPECT_EQ(owned.hits, 500U);
    EXPECT_EQ(owned.leaks + owned.doubles + owned.parity_errors + owned.wrong_owners, 0U);
    const Tally closed = tally_of(*at_vertices, inclusive);
    EXPECT_EQ(closed.doubles, 500U);
    EXPECT_EQ(closed.leaks, 0U);
    EXPECT_GT(closed.hits, 4 * 500U);
    const Tally open = tally_of(*at_vertices, exclusive);
    EXPECT_EQ(open.leaks, 500U);
    EXPECT_EQ(open.parity_errors, 500U);
    EXPECT_EQ(open.hits, 0U);
    EXPECT_EQ(open.false_misses, 0U);  // no triangle is met inside
}

// Three hits of one crossing: parity is right, the net crossing is not.
TEST(Stability, CountsADoubleHitThatParityDoesNotShow) {
    const auto surface = placed_surface(closed_mesh("tetrahedron").make(), {});
    const auto at_vertices = surface_experiment(surface, rays_at(surface, 0.5F, {}, Aim::Vertex));
    const Tally closed = tally_of(*at_vertices, inclusive);
    EXPECT_EQ(closed.hits, 3 * closed.rays);
    EXPECT_EQ(closed.doubles, closed.rays);
    EXPECT_EQ(closed.parity_errors, 0U);
}

// All rays hit the neighbour that they touch instead of the owner: nothing leaks.
TEST(Stability, TellsAWrongOwnerFromALeak) {
    const auto two = fan_experiment(
        [](RandomStream& random) {
            const float x = draw_between(random, -1, 1);
            return Fan{
                {{x, 0, 4}, 0, {0, 0, -1}, infinity},
                {Corners{Vec3{-2, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {Vec3{2, 0, 0}, {-2, 0, 0}, {0, -2, 0}}}};
        },
        2);
    EXPECT_EQ(tally_of(*two, owner).wrong_owners, 0U);
    const Tally other = tally_of(
        *two, [](const OracleDecision& exact) { return exact.is_owner ? std::nullopt : inclusive(exact); });
    EXPECT_EQ(other.wrong_owners, other.rays);
    EXPECT_EQ(other.leaks + other.doubles + other.parity_errors, 0U);
}

TEST(Stability, ForgivesASilhouetteThatMovesButNotALostSurface) {
    const auto surface = placed_surface(closed_mesh("cube").make(), {});
    // Through the cube: in and out.
    const auto through = surface_experiment(surface, [](RandomStream& random) {
        return ray_through({3, 0.1F, 0.2F}, draw_point(random, 0.3F));
    });
    const Tally none = tally_of(*through, [](const OracleDecision&) { return std::nullopt; });
    EXPECT_EQ(none.leaks + none.doubles, 0U);
    EXPECT_EQ(none.wrong_owners, none.rays);
    EXPECT_EQ(none.false_misses, 2 * none.rays);
    const Tally half = tally_of(
        *through, [](const OracleDecision& exact) { return exact.t > 1 ? std::nullopt : owner(exact); });
    EXPECT_EQ(half.leaks, half.rays);
    EXPECT_EQ(half.parity_errors, half.rays);
}

TEST(Stability, WantsAllTrianglesOnOneSideOfAnEdge) {
    const auto fan = edge_experiment(fan_at_edge(5), 5);
    EXPECT_EQ(failures(fan->measured(), tally_of(*fan, owner)), 0U);
    const Tally all = tally_of(*fan, [](const OracleDecision&) { return std::optional(TestHit{1, 0, 0}); });
    const Tally none = tally_of(*fan, [](const OracleDecision&) { return std::nullopt; });
    EXPECT_GT(all.doubles, 300U);
    EXPECT_EQ(none.leaks, all.doubles);  // where all are on one side, both answers are right
    EXPECT_EQ(all.leaks + none.doubles, 0U);
}

TEST(Stability, MeasuresErrorsInUnitsOfTheExactT) {
    const auto ordinary = triangle_experiment(probe_of_size(1, 3, 0, Target::Inside));
    const Tally off = tally_of(*ordinary, [](const OracleDecision& exact) {
        auto hit = owner(exact);
        if (hit) hit->t = std::nextafter(std::nextafter(hit->t, infinity), infinity);
        if (hit) hit->u += 0x1p-20F;
        return hit;
    });
    EXPECT_GE(off.t_ulp.max(), 1.5);
    EXPECT_LE(off.t_ulp.max(), 4.5);  // two units of t, four of an exact t below a power of two
    EXPECT_NEAR(*off.uv_ulp.quantile(0.5), 16, 1);
    EXPECT_EQ(off.false_hits + off.false_misses, 0U);
    const Tally nan = tally_of(*ordinary, [](const OracleDecision& exact) {
        auto hit = owner(exact);
        if (hit) hit->v = std::numeric_limits<float>::quiet_NaN();
        return hit;
    });
    EXPECT_EQ(nan.non_finite, nan.hits);
    EXPECT_GT(nan.non_finite, 400U);
}

TEST(Stability, KnowsByHowMuchADecisionIsWrong) {
    const auto beside = triangle_experiment(probe_beside_edge(64));
    const Tally open = tally_of(*beside, [](const OracleDecision&) { return std::nullopt; });
    EXPECT_GT(open.false_misses, 100U);
    EXPECT_NEAR(open.false_miss_margin, 64, 2);
    const Tally full = tally_of(*beside, [](const OracleDecision&) {
        return std::optional(TestHit{1, 0, 0});
    });
    EXPECT_EQ(full.false_hits, 500 - open.false_misses);
    EXPECT_NEAR(full.false_hit_margin, 64, 2);
}

// An answer that depends on what must not matter.
TEST(Stability, SeesChangedAnswers) {
    const DrawProbe draw = probe_of_size(1, 3, 0, Target::Inside);
    const auto expect_seen = [&](Change change, const auto& answer) {
        class Odd : public Imagined {
          public:
            Odd(decltype(answer) how) : Imagined(owner), how_(how) {}
            [[nodiscard]] std::optional<TestHit> test(const Ray& ray, const Corners& corners) const override {
                return how_(ray, corners) ? Imagined::test(ray, corners) : std::nullopt;
            }

          private:
            decltype(answer) how_;
        };
        std::vector<std::unique_ptr<Subject>> subjects;
        subjects.push_back(std::make_unique<Odd>(answer));
        std::vector<Tally> tallies(1);
        const auto experiment = variant_experiment(draw, change);
        for (std::uint32_t i = 0; i < 100; ++i) {
            RandomStream random(1, 78, i);
            experiment->examine(random, subjects, tallies);
        }
        EXPECT_GT(tallies[0].variant_errors, 20U) << int(change);
        if (change == Change::Shrinking) return;
        EXPECT_EQ(tally_of(*experiment, owner, 100).variant_errors, 0U) << int(change);
    };
    expect_seen(Change::Rotation, [](const Ray&, const Corners& c) { return c[0].x < c[1].x; });
    expect_seen(Change::Winding, [](const Ray& r, const Corners& c) { return facing(r, c) > 0; });
    expect_seen(Change::Axes, [](const Ray& r, const Corners&) { return r.direction.y > r.direction.z; });
    expect_seen(Change::PowerOfTwo,
                [](const Ray& r, const Corners&) { return std::abs(r.direction.x) > 0.01F; });
    expect_seen(Change::Shrinking, [](const Ray& r, const Corners&) { return r.t_max > 1e6F; });
}

TEST(Stability, SeesSelfHitsAndWrongOrder) {
    const DrawProbe draw = probe_of_size(1, 3, 0, Target::Inside);
    const Tally left = tally_of(*self_hit_experiment(draw, Start::MovedOffSurface), owner);
    EXPECT_EQ(left.self_hits, 0U);
    EXPECT_GT(left.rays, 450U);
    EXPECT_GT(tally_of(*self_hit_experiment(draw, Start::PointOfT), owner).self_hits, 100U);
    const Tally wrong = tally_of(*order_experiment(draw, 64), [](const OracleDecision& exact) {
        auto hit = owner(exact);
        if (hit) hit->t = -hit->t;
        return hit;
    });
    EXPECT_GT(wrong.order_errors, 400U);
    EXPECT_EQ(tally_of(*order_experiment(draw, 64), owner).order_errors, 0U);
    const Tally early = tally_of(*box_experiment(draw, Slab::Machine), [](const OracleDecision& exact) {
        auto hit = owner(exact);
        if (hit) hit->t *= 0.25F;
        return hit;
    });
    EXPECT_GT(early.box_errors, 400U);
}

StabilityReport report_of(std::vector<std::string> cases, std::uint64_t rays,
                          std::vector<std::string> methods = {}) {
    StabilityOptions options;
    options.cases = std::move(cases);
    options.methods = std::move(methods);
    options.rays = rays;
    return run_stability(options);
}

TEST(Stability, IsTheSameWhateverTheNumberOfThreads) {
    const std::vector<std::string> cases{"shared_vertex", "slivers", "reintersect", "invariance"};
    const auto all = stability_json(report_of(cases, 40));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(stability_json(report_of(cases, 40)), all);
}

TEST(Stability, DrawsTheSameRaysWhateverElseIsAsked) {
    const StabilityReport all = report_of({"slivers", "tiny"}, 50);
    const StabilityReport one = report_of({"tiny"}, 50, {"woop"});
    std::size_t compared = 0;
    for (const StabilityRow& row : one.rows) {
        for (const StabilityRow& other : all.rows) {
            if (other.method != row.method || other.contraction != row.contraction ||
                all.cases[other.case_index].name != "tiny" || other.parameter != row.parameter) {
                continue;
            }
            ++compared;
            for (const StabilityField& field : stability_fields()) {
                EXPECT_EQ(field.value(row), field.value(other)) << field.key;
            }
        }
    }
    EXPECT_EQ(compared, one.rows.size());
}

TEST(Stability, RefusesWhatItDoesNotKnow) {
    const auto message = [](std::vector<std::string> cases, std::vector<std::string> methods) {
        try {
            report_of(std::move(cases), 1, std::move(methods));
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(message({"sliver"}, {}), testing::AllOf(testing::HasSubstr("shared_edge, shared_vertex"),
                                                        testing::HasSubstr("got 'sliver'")));
    EXPECT_THAT(message({}, {"mt"}), testing::AllOf(testing::HasSubstr("moller_trumbore"),
                                                    testing::HasSubstr("embree_robust, got 'mt'")));
    EXPECT_THAT(message({"tiny", "tiny"}, {}), testing::HasSubstr("'tiny' is given twice"));
}

TEST(Stability, HasTheTwentyOneCasesOnce) {
    std::map<int, int> numbers;
    for (const StabilityCase& one : stability_cases()) ++numbers[one.number];
    for (int number = 1; number <= 21; ++number) EXPECT_EQ(numbers[number], 1) << number;
}

}  // namespace
}  // namespace rtu::study
