// The RTU in SystemVerilog beside the simulator, ray by ray and cycle by cycle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "model/gltf.hpp"
#include "rtu_cases.hpp"
#include "sim/config_keys.hpp"
#include "tests/model/meshes.hpp"
#include "tests/scenes.hpp"

namespace rtu {
namespace {

using model::WorkloadKind;
using rtl::RtlConfig;
using rtl::RtlResult;
using rtl::TesterMode;
using test::RtuScene;

const RtuScene& builtin(std::uint32_t width) {
    static std::array<std::unique_ptr<RtuScene>, model::max_bvh_width + 1> scenes;
    auto& scene = scenes[width];
    if (!scene) scene = std::make_unique<RtuScene>(model::builtin_scene(), width);
    return *scene;
}

std::uint64_t scheduler_counter(const sim::MachineResult& result, std::string_view name) {
    for (const sim::UnitResult& unit : result.units) {
        for (const sim::CounterValue& counter : unit.counters) {
            if (unit.name == "scheduler" && counter.name == name) return counter.value;
        }
    }
    ADD_FAILURE() << "the scheduler has no counter " << name;
    return 0;
}

// Bits, not values: hits have no padding, and zeros of two signs differ.
bool is_same(const std::optional<model::Hit>& a, const std::optional<model::Hit>& b) {
    return a.has_value() == b.has_value() && (!a || std::memcmp(&*a, &*b, sizeof *a) == 0);
}

void expect_same_hits(const RtlResult& rtl, const sim::MachineResult& simulated) {
    ASSERT_EQ(rtl.hits.size(), simulated.hits.size());
    for (std::size_t i = 0; i < rtl.hits.size(); ++i) {
        ASSERT_TRUE(is_same(rtl.hits[i], simulated.hits[i])) << "ray " << i;
    }
}

// How many times the columns and rows of rays are drawn, for longer runs.
std::uint32_t ray_scale() {
    const char* scale = std::getenv("RTUSIM_RTL_RAYS");
    return scale != nullptr ? std::uint32_t(std::max(1, std::atoi(scale))) : 1;
}

// Runs both; all but the cycles must be equal, and the cycles within `percent`.
void compare(const RtlConfig& config, const RtuScene& scene, const model::Workload& workload,
             double percent) {
    const sim::MachineResult simulated =
        sim::simulate(test::simulated(config), scene.image, workload.rays, workload.ray_kind);
    const RtlResult rtl = rtl::run_rtl(scene.image, workload.rays, workload.ray_kind, config);
    expect_same_hits(rtl, simulated);
    EXPECT_EQ(rtl.counts.node_visits, simulated.counts.node_visits);
    EXPECT_EQ(rtl.counts.box_tests, simulated.counts.box_tests);
    EXPECT_EQ(rtl.counts.pair_tests, simulated.counts.pair_tests);
    EXPECT_EQ(rtl.counts.triangle_tests, simulated.counts.triangle_tests);
    EXPECT_EQ(rtl.counts.mailbox_hits, simulated.counts.mailbox_hits);
    if (config.mailbox_entries > 0) {
        EXPECT_EQ(rtl.mailbox_lookups, scheduler_counter(simulated, "mailbox_lookups"));
    }
    EXPECT_EQ(rtl.spilled_entries, scheduler_counter(simulated, "spilled_entries"));
    EXPECT_EQ(rtl.reloaded_entries, scheduler_counter(simulated, "reloaded_entries"));
    const double error = 100.0 * (double(simulated.cycles) - double(rtl.cycles)) / double(rtl.cycles);
    EXPECT_LE(std::abs(error), percent) << "simulated " << simulated.cycles << " cycles, RTL " << rtl.cycles;
    testing::Test::RecordProperty("rtl_cycles", int(rtl.cycles));
    testing::Test::RecordProperty("sim_cycles", int(simulated.cycles));
}

struct Case {
    std::string name;
    WorkloadKind kind = WorkloadKind::Primary;
    std::uint32_t columns = 24, rows = 18;
    RtlConfig config{};
    double percent = 0.1;  ///< what the rare cases may cost that the simulator does not time
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Rtu : public testing::TestWithParam<Case> {};

TEST_P(Rtu, GivesTheHitsAndCountsAndCyclesOfTheSimulator) {
    const Case& c = GetParam();
    const RtuScene& scene = builtin(c.config.width);
    compare(c.config, scene,
            scene.rays(c.kind, model::builtin_camera(), ray_scale() * c.columns, ray_scale() * c.rows),
            c.percent);
}

constexpr RtlConfig::Cache tiny_cache{
    .sets = 4, .ways = 2, .banks = 2, .mshrs = 4, .targets_per_mshr = 2, .latency_cycles = 4};

std::vector<Case> cases() {
    using enum WorkloadKind;
    return {
        {"one_slot", Primary, 4, 3, {.slots = 1}},
        {"two_slots", Diffuse, 6, 4, {.slots = 2}},
        {"sixteen_slots", Primary, 24, 18, {.slots = 16}},
        {"sixty_four_slots", Diffuse, 40, 30, {.slots = 64}},
        {"all_slots", Shadow, 48, 36, {.slots = 128}},
        {"stack_of_one", Shadow, 16, 12, {.slots = 16, .stack_entries = 1}},
        {"stack_of_two", Diffuse, 24, 18, {.slots = 64, .stack_entries = 2}},
        {"stack_of_four", Primary, 24, 18, {.slots = 64, .stack_entries = 4}},
        {"tiny_cache", Diffuse, 12, 9, {.slots = 16, .stack_entries = 4, .cache = tiny_cache}},
        {"slow_memory", Primary, 16, 12, {.slots = 32, .memory = {400, 4}}},
        {"fast_memory", Diffuse, 32, 24, {.slots = 64, .memory = {20, 128}}},
        {"single", Diffuse, 32, 24, {.mode = TesterMode::Single, .slots = 64}},
        {"dual_independent", Diffuse, 32, 24, {.mode = TesterMode::DualIndependent, .slots = 64}},
        {"two_wide", Shadow, 32, 24, {.width = 2, .slots = 64}},
        {"two_wide_stack_of_two", Primary, 16, 12, {.width = 2, .slots = 16, .stack_entries = 2}},
        {"eight_wide", Primary, 32, 24, {.width = 8, .slots = 64}},
        {"eight_wide_stack_of_two", Shadow, 16, 12, {.width = 8, .slots = 16, .stack_entries = 2}},
    };
}

INSTANTIATE_TEST_SUITE_P(OnBuiltinRays, Rtu, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

constexpr std::string_view timing_numbers[] = {
    "rtu.results_per_cycle",  "rtu.fetches_per_cycle",   "rtu.scheduler.latency_cycles",
    "rtu.box.latency_cycles", "rtu.pair.latency_cycles", "rtu.pair.ii_cycles",
    "rtu.pair.hit_cycles",    "rtu.pair.reject_cycles",  "rtu.pair.hit_units",
    "rtu.pair.entries",       "l1.latency_cycles",
};

std::uint32_t& number(sim::Config& config, std::string_view name) {
    const auto key = std::ranges::find(sim::config_keys(), name, &sim::ConfigKey::name);
    return *std::get<std::uint32_t*>(key->field(config));
}

// So the defaults are read off the RTL: no other number gives its cycles. Memory is fast, or it would hide
// them.
TEST(RtuTiming, IsThatOfTheDefaultMachineAndOfNoNumberBesideIt) {
    const RtlConfig config{.slots = 128, .stack_entries = 1, .memory = {20, 128}};
    const RtuScene& scene = builtin(4);
    const model::Workload rays =
        test::without_open_sides(scene, scene.rays(WorkloadKind::Primary, model::builtin_camera(), 32, 24));
    const auto cycles = [&](const sim::Config& machine) {
        return sim::simulate(machine, scene.image, rays.rays, rays.ray_kind).cycles;
    };
    const std::uint64_t expected = rtl::run_rtl(scene.image, rays.rays, rays.ray_kind, config).cycles;
    ASSERT_EQ(cycles(test::simulated(config)), expected);
    for (const std::string_view name : timing_numbers) {
        for (const int step : {-1, 1}) {
            sim::Config other = test::simulated(config);
            if (number(other, name) == 1 && step < 0) continue;
            number(other, name) += std::uint32_t(step);
            EXPECT_NE(cycles(other), expected) << name << " = " << number(other, name);
        }
    }
}

// Long thin triangles under spatial splits: more than three leaves for two pairs.
const RtuScene& split_needles() {
    static const RtuScene scene(
        test::needles(600, 3, {0, 0, 0}),
        {.width = 4, .splits = model::SplitKind::Spatial, .split_budget_percent = 200});
    return scene;
}

// Through the middle of a triangle each, from anywhere around.
model::Workload needle_rays(const model::TriangleMesh& mesh, std::uint32_t count, model::RayKind kind) {
    test::Random random(7);
    model::Workload workload;
    workload.ray_kind = kind;
    for (std::uint32_t i = 0; i < count * ray_scale(); ++i) {
        const model::Triangle& triangle = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
        model::Vec3 middle;
        for (const std::uint32_t corner : triangle) middle = middle + mesh.positions[corner] * (1.0F / 3);
        const model::Vec3 origin = random.point(-2, 2);
        workload.rays.push_back({origin, 0, middle - origin, std::numeric_limits<float>::infinity()});
    }
    return workload;
}

struct MailboxCase {
    std::string name;
    model::RayKind kind = model::RayKind::ClosestHit;
    RtlConfig config{};
};

void PrintTo(const MailboxCase& c, std::ostream* out) { *out << c.name; }

class RtuMailbox : public testing::TestWithParam<MailboxCase> {};

TEST_P(RtuMailbox, GivesTheHitsAndLookUpsAndCyclesOfTheSimulator) {
    const RtuScene& scene = split_needles();
    ASSERT_GT(2 * scene.image.reference_count, 3 * scene.image.pair_count);
    const model::Workload rays =
        test::without_open_sides(scene, needle_rays(scene.mesh, 60, GetParam().kind));
    ASSERT_GT(rays.rays.size(), 30);
    compare(GetParam().config, scene, rays, 0);
}

std::vector<MailboxCase> mailbox_cases() {
    using enum model::RayKind;
    return {
        {"none", ClosestHit, {.slots = 64}},
        {"one_entry", ClosestHit, {.slots = 64, .mailbox_entries = 1}},
        {"four_entries", ClosestHit, {.slots = 64, .mailbox_entries = 4}},
        {"five_entries_any_hit", AnyHit, {.slots = 64, .mailbox_entries = 5}},
        {"sixteen_entries", ClosestHit, {.slots = 128, .mailbox_entries = 16}},
        {"stack_of_one", ClosestHit, {.slots = 64, .stack_entries = 1, .mailbox_entries = 16}},
        {"stack_of_two_any_hit", AnyHit, {.slots = 16, .stack_entries = 2, .mailbox_entries = 8}},
        {"stack_of_four", ClosestHit, {.slots = 128, .stack_entries = 4, .mailbox_entries = 16}},
        {"tiny_cache",
         ClosestHit,
         {.slots = 16, .stack_entries = 2, .mailbox_entries = 16, .cache = tiny_cache}},
    };
}

INSTANTIATE_TEST_SUITE_P(OnNeedles, RtuMailbox, testing::ValuesIn(mailbox_cases()),
                         [](const auto& test) { return test.param.name; });

class RtuOnScene : public testing::TestWithParam<std::string> {};

TEST_P(RtuOnScene, GivesTheHitsAndCountsAndCyclesOfTheSimulator) {
    const auto file = test::scene_file(GetParam() + ".glb");
    if (!file) GTEST_SKIP() << GetParam() << ".glb is not there";
    const RtuScene scene(model::load_gltf(*file), 4);
    const model::Camera camera = model::automatic_camera(scene.mesh, scene.image);
    for (const auto kind : {WorkloadKind::Primary, WorkloadKind::Diffuse}) {
        SCOPED_TRACE(kind == WorkloadKind::Primary ? "primary" : "diffuse");
        const model::Workload rays = scene.rays(kind, camera, 48 * ray_scale(), 36 * ray_scale());
        compare({.slots = 128}, scene, rays, 0.5);
        // So few rays that no quotient of theirs is all but half way between two floats.
        const model::Workload plain = scene.rays(kind, camera, 24, 18);
        compare({.slots = 128}, scene, test::without_open_sides(scene, plain), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(WhereThere, RtuOnScene, testing::Values("bunny", "conference", "dragon"),
                         [](const auto& test) { return test.param; });

TEST(RtuUnderPressure, LosesNothing) {
    const RtuScene& scene = builtin(4);
    for (const auto kind : {WorkloadKind::Diffuse, WorkloadKind::Shadow}) {
        const model::Workload workload = scene.rays(kind, model::builtin_camera(), 16, 12);
        const RtlConfig config{.slots = 24, .stack_entries = 3, .cache = tiny_cache, .memory = {30, 32}};
        const auto simulated =
            sim::simulate(test::simulated(config), scene.image, workload.rays, workload.ray_kind);
        const rtl::Disturbance disturbance{.seed = 5, .hesitates = true};
        const RtlResult rtl =
            rtl::run_rtl(scene.image, workload.rays, workload.ray_kind, config, nullptr, &disturbance);
        expect_same_hits(rtl, simulated);
        EXPECT_EQ(rtl.counts, simulated.counts);
        EXPECT_EQ(rtl.spilled_entries, scheduler_counter(simulated, "spilled_entries"));
    }
}

TEST(RtuUnderPressure, PassesNoLeafOverThatItShouldNot) {
    const RtuScene& scene = split_needles();
    const model::Workload workload = needle_rays(scene.mesh, 40, model::RayKind::ClosestHit);
    const RtlConfig config{.slots = 48, .stack_entries = 2, .mailbox_entries = 16, .cache = tiny_cache};
    const auto simulated =
        sim::simulate(test::simulated(config), scene.image, workload.rays, workload.ray_kind);
    for (const std::uint64_t seed : {1, 2}) {
        const rtl::Disturbance disturbance{.seed = seed, .hesitates = true};
        const RtlResult rtl =
            rtl::run_rtl(scene.image, workload.rays, workload.ray_kind, config, nullptr, &disturbance);
        expect_same_hits(rtl, simulated);
        EXPECT_EQ(rtl.counts.pair_tests, simulated.counts.pair_tests);
        EXPECT_EQ(rtl.counts.mailbox_hits, simulated.counts.mailbox_hits);
        EXPECT_EQ(rtl.spilled_entries, scheduler_counter(simulated, "spilled_entries"));
    }
}

TEST(RtuAfterReset, DependsOnNothingThatItsRegistersHeld) {
    const RtuScene& scene = builtin(4);
    const model::Workload workload = scene.rays(WorkloadKind::Diffuse, model::builtin_camera(), 12, 8);
    const RtlConfig config{.slots = 16, .stack_entries = 4};
    const RtlResult expected = rtl::run_rtl(scene.image, workload.rays, workload.ray_kind, config);
    for (const std::uint64_t seed : {1, 2, 3}) {
        const rtl::Disturbance disturbance{.seed = seed};
        const RtlResult rtl =
            rtl::run_rtl(scene.image, workload.rays, workload.ray_kind, config, nullptr, &disturbance);
        EXPECT_EQ(rtl.cycles, expected.cycles);
        EXPECT_EQ(rtl.counts, expected.counts);
        EXPECT_EQ(rtl.cache_hits, expected.cache_hits);
        ASSERT_TRUE(std::ranges::equal(rtl.hits, expected.hits, is_same));
    }
}

TEST(RtuAnswers, RaysThatCannotHitAtOnce) {
    const RtuScene& scene = builtin(4);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const model::Ray no_direction{{0, 0, 0}, 0, {0, 0, 0}, 1}, no_number{{nan, 0, 0}, 0, {1, 0, 0}, 1};
    const std::vector<model::Ray> rays{no_direction, no_number, no_direction};
    const RtlConfig config{.slots = 1};
    const RtlResult rtl = rtl::run_rtl(scene.image, rays, model::RayKind::ClosestHit, config);
    EXPECT_TRUE(std::ranges::none_of(rtl.hits, [](const auto& hit) { return hit.has_value(); }));
    EXPECT_EQ(rtl.counts.node_visits, 0U);
    const auto simulated =
        sim::simulate(test::simulated(config), scene.image, rays, model::RayKind::ClosestHit);
    EXPECT_EQ(rtl.cycles, simulated.cycles);
}

std::string error_of(const model::MemoryImage& image, const RtlConfig& config,
                     const rtl::Waves* waves = nullptr) {
    const model::Ray ray{{0, 0, 0}, 0, {0, 0, 1}, 1};
    try {
        (void)rtl::run_rtl(image, std::span(&ray, 1), model::RayKind::ClosestHit, config, waves);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(RtuRefuses, WhatItCannotBe) {
    const model::MemoryImage& image = builtin(4).image;
    EXPECT_TRUE(rtl::has_build({}));
    EXPECT_FALSE(rtl::has_build({.width = 6}));
    EXPECT_TRUE(rtl::has_build({.mailbox_entries = 16}));
    EXPECT_FALSE(rtl::has_build({.width = 2, .mailbox_entries = 1}));
    EXPECT_EQ(error_of(image, {.width = 6}),
              "rtl: an RTU of width 6, pair mode 2, 8 hit units and 0 mailbox entries was not built");
    EXPECT_EQ(error_of(image, {.slots = 0}), "rtl: slots: expected a number from 1 to 128, got 0");
    EXPECT_EQ(error_of(image, {.stack_entries = 17}),
              "rtl: stack entries: expected a number from 1 to 16, got 17");
    EXPECT_EQ(error_of(image, {.cache = {.sets = 12}}), "rtl: cache sets: expected a power of two, got 12");
    EXPECT_EQ(error_of(image, {.width = 2}), "rtl: expected a tree of width 2, got 4");
    const RtuScene two_pairs(model::builtin_scene(), 4, 2);
    EXPECT_NE(error_of(two_pairs.image, {}).find("expected leaves of one pair"), std::string::npos);
}

TEST(RtuRefuses, WavesThatItDoesNotWrite) {
    const rtl::Waves waves{"somewhere.png", 0, 10};
    EXPECT_EQ(error_of(builtin(4).image, {}, &waves).find("somewhere.png: expected "), 0U);
}

}  // namespace
}  // namespace rtu
