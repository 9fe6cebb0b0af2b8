#include <Vbox_tester_4.h>
#include <Vhit_unit.h>
#include <Vpair_reject_2.h>
#include <gtest/gtest.h>

#include <vector>

#include "box_vectors.hpp"
#include "hit_vectors.hpp"
#include "model/builtin_scene.hpp"
#include "model/bvh.hpp"
#include "model/camera.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "rtl_ref/harness/stream.hpp"

namespace rtu {
namespace {

using model::WorkloadKind;

// What the units are given while rays cross the built-in scene.
struct Visits {
    std::vector<test::BoxVector<4>> nodes;
    std::vector<test::HitVector> pairs;
};

void visit_leaf(const model::MemoryImage& image, model::Traversal& traversal, Visits& visits) {
    for (std::uint32_t i = 0; i < traversal.current.ref.pair_count(); ++i) {
        const auto& [best, is_found] = traversal.closest;
        visits.pairs.push_back({{image.leaf_pair(traversal.current.ref, i), traversal.ray, std::uint8_t(i)},
                                is_found ? std::optional(best) : std::nullopt,
                                traversal.ray.t_max});
        model::visit_pair(traversal, image, i);
    }
}

void visit_all(const model::MemoryImage& image, const model::Workload& workload, Visits& visits) {
    model::Traversal traversal;
    for (const model::Ray& ray : workload.rays) {
        bool is_under_way = model::start(traversal, image, ray, workload.ray_kind);
        while (is_under_way) {
            if (traversal.current.ref.is_leaf()) {
                visit_leaf(image, traversal, visits);
            } else {
                visits.nodes.push_back(
                    {image.node<4>(traversal.current.ref), traversal.ray, traversal.closest.hit.t, 1});
                model::visit_node(traversal, image);
            }
            is_under_way = !model::is_satisfied(traversal) && model::pop(traversal);
        }
    }
}

const Visits& scene_visits() {
    static const Visits visits = [] {
        const model::TriangleMesh mesh = model::builtin_scene();
        const model::Pairing pairing = model::pair_triangles(mesh, {}, model::EdgeIdentity::Position);
        const model::MemoryImage image = model::build_bvh(mesh, pairing, {});
        Visits result;
        for (const auto kind : {WorkloadKind::Primary, WorkloadKind::Shadow, WorkloadKind::Diffuse}) {
            visit_all(image, model::make_workload(kind, mesh, image, model::builtin_camera(), {64, 48}, 1),
                      result);
        }
        return result;
    }();
    return visits;
}

// Takes recorded vectors one after the other.
template <class Vector>
auto replay(const std::vector<Vector>& vectors) {
    return [&vectors, next = std::size_t{0}]() mutable { return vectors[next++]; };
}

TEST(SceneRays, MeetTheBoxesOfTheModel) {
    const auto& nodes = scene_visits().nodes;
    ASSERT_GT(nodes.size(), 100'000U);
    Vbox_tester_4 unit;
    test::BoxReference<4> reference;
    const auto drive = [](auto& rtl, const auto& vector) { test::drive(rtl, vector); };
    const auto check = [&](const auto& rtl, const auto& vector, std::uint64_t /*cycles*/) {
        if (!HasFatalFailure()) test::expect_as_model(rtl, vector, reference);
    };
    EXPECT_TRUE(rtl::run_stream(unit, nodes.size(), replay(nodes), drive, check));
}

TEST(SceneRays, SendTheTrianglesOfTheModelToTheSecondPass) {
    const auto& pairs = scene_visits().pairs;
    ASSERT_GT(pairs.size(), 10'000U);
    Vpair_reject_2 unit;
    int triangles = 0, goes_on = 0, is_inside = 0;
    const auto count = [](std::uint32_t bits) { return std::popcount(bits); };
    const auto drive = [](auto& rtl, const auto& vector) { test::drive(rtl, vector.pair); };
    const auto check = [&](const auto& rtl, const test::HitVector& vector, std::uint64_t /*cycles*/) {
        if (HasFatalFailure()) return;
        ASSERT_EQ(rtl.goes_on_o, test::goes_on_in_model(vector.pair));
        triangles += vector.pair.pair.has_second() ? 2 : 1;
        goes_on += count(rtl.goes_on_o);
        is_inside += count(rtl.is_inside_o);
    };
    EXPECT_TRUE(rtl::run_stream(unit, pairs.size(), replay(pairs), drive, check));
    RecordProperty("pairs", int(pairs.size()));
    RecordProperty("triangles", triangles);
    RecordProperty("goes_on", goes_on);
    RecordProperty("is_inside", is_inside);
    // What the first pass lets through is mostly hit, and then it knows the sides.
    EXPECT_GT(is_inside, goes_on * 95 / 100);
}

TEST(SceneRays, FindTheHitsOfTheModel) {
    std::vector<test::SecondPass> survivors;
    for (const test::HitVector& vector : scene_visits().pairs) {
        test::SecondPass survivor{vector, std::uint8_t(test::goes_on_in_model(vector.pair))};
        for (std::uint32_t i = 0; i < 2; ++i) {
            if ((survivor.goes_on >> i & 1U) != 0 && test::is_inside_exactly(vector.pair, i))
                survivor.is_inside = std::uint8_t(survivor.is_inside | 1U << i);
        }
        if (survivor.goes_on != 0) survivors.push_back(survivor);
    }
    Vhit_unit unit;
    int found = 0;
    const auto drive = [](auto& rtl, const auto& vector) { test::drive(rtl, vector); };
    const auto check = [&](const auto& rtl, const test::SecondPass& vector, std::uint64_t /*cycles*/) {
        if (!HasFatalFailure()) test::expect_as_model(rtl, vector.hit);
        found += rtl.found_o;
    };
    const auto cycles = rtl::run_stream(unit, survivors.size(), replay(survivors), drive, check);
    ASSERT_TRUE(cycles);
    RecordProperty("survivors", int(survivors.size()));
    RecordProperty("better_hits", found);
    RecordProperty("cycles", int(cycles->total));
}

}  // namespace
}  // namespace rtu
