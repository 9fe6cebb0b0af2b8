#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "machine_fixture.hpp"
#include "model/error.hpp"
#include "sim/machine.hpp"
#include "traces/visit_recorder.hpp"

namespace rtu::sim {
namespace {

using model::RayKind;

struct Variant {
    const char* name;
    void (*change)(Config&);
};

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

const Variant variants[] = {
    {"default", [](Config&) {}},
    {"tiny", [](Config& c) { c = test::tiny_machine(); }},
    {"one_slot", [](Config& c) { c.rtu.ray_slots = 1; }},
    {"three_rtus", [](Config& c) { c.rtu.count = 3, c.host.rays_per_cycle = 2; }},
    {"one_lane", [](Config& c) { c.rtu.box.boxes_per_cycle = 1; }},
    {"twelve_lanes", [](Config& c) { c.rtu.box.boxes_per_cycle = 12; }},
    {"single", [](Config& c) { c.rtu.pair.mode = PairMode::Single; }},
    {"dual_independent", [](Config& c) { c.rtu.pair.mode = PairMode::DualIndependent; }},
    {"published_pipeline",
     [](Config& c) {
         c.rtu.pair.hit_units = 0, c.rtu.pair.latency_cycles = 22, c.rtu.pair.replay_cycles = 1;
     }},
    {"one_hit_unit",
     [](Config& c) {
         c.rtu.pair.hit_units = 1, c.rtu.pair.entries = 3;
         c.rtu.pair.hit_cycles = 40, c.rtu.pair.reject_cycles = 17;
     }},
    {"three_slow_testers", [](Config& c) { c.rtu.pair.testers = 3, c.rtu.pair.ii_cycles = 5; }},
    {"packed_nodes", [](Config& c) { c.rtu.box.packs_nodes = 1, c.rtu.box.boxes_per_cycle = 8; }},
    {"scheduler_without_latency", [](Config& c) { c.rtu.scheduler.latency_cycles = 0; }},
    {"slow_scheduler", [](Config& c) { c.rtu.scheduler.latency_cycles = 17; }},
    {"stack_of_one", [](Config& c) { c.rtu.stack_entries = 1; }},
    {"flat_memory", [](Config& c) { c.memory.model = MemoryModel::Flat; }},
    {"tiny_with_flat_memory",
     [](Config& c) {
         c = test::tiny_machine();
         c.rtu.count = 2;
         c.memory = {MemoryModel::Flat, 30, 8};
     }},
    {"narrow_scheduler", [](Config& c) { c.rtu.results_per_cycle = c.rtu.fetches_per_cycle = 1; }},
};

std::uint64_t counter(const std::vector<UnitResult>& units, std::string_view unit, std::string_view name) {
    for (const UnitResult& u : units) {
        if (u.name != unit) continue;
        for (const CounterValue& c : u.counters) {
            if (c.name == name) return c.value;
        }
    }
    ADD_FAILURE() << "no counter " << unit << "." << name;
    return 0;
}

class Machine : public testing::TestWithParam<Variant> {
  protected:
    Machine() { GetParam().change(config_); }
    Config config_;
};

TEST_P(Machine, GivesTheReferencesHitsAndCounts) {
    for (const model::BvhOptions options : {model::BvhOptions{4, 1}, {2, 1}, {8, 1}, {4, 3}}) {
        const auto mesh = test::triangle_soup(800, 3, 0.15F);
        const auto image = test::image_of(mesh, options);
        const auto rays = test::rays_into_unit_cube(400, 4);
        for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
            const MachineResult result = simulate(config_, image, rays, kind);
            model::TraversalCounts counts;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_EQ(result.hits[i], model::trace(image, rays[i], kind, &counts)) << "ray " << i;
            }
            EXPECT_EQ(result.counts, counts);
        }
    }
}

void expect_equal(const MachineResult& a, const MachineResult& b) {
    EXPECT_EQ(a.cycles, b.cycles);
    EXPECT_EQ(a.counts, b.counts);
    EXPECT_EQ(a.hits, b.hits);
    for (const auto member : {&MachineResult::units, &MachineResult::memory}) {
        ASSERT_EQ((a.*member).size(), (b.*member).size());
        for (std::size_t i = 0; i < (a.*member).size(); ++i) {
            const UnitResult &x = (a.*member)[i], &y = (b.*member)[i];
            EXPECT_EQ(x.cycles, y.cycles) << x.name;
            for (std::size_t k = 0; k < x.counters.size(); ++k) {
                EXPECT_EQ(x.counters[k].value, y.counters[k].value) << x.name << " " << x.counters[k].name;
            }
        }
    }
}

TEST_P(Machine, GivesTheSameCyclesAndCountersInBothClockModes) {
    const auto image = test::image_of(test::triangle_soup(300, 5, 0.2F));
    const auto rays = test::rays_into_unit_cube(150, 6);
    const MachineResult fast = simulate(config_, image, rays, RayKind::ClosestHit, ClockMode::Fast);
    const MachineResult verify = simulate(config_, image, rays, RayKind::ClosestHit, ClockMode::Verify);
    expect_equal(fast, verify);
}

// The chunks of recorded traversals, ray by ray.
class RecordedSupply final : public RaySupply {
  public:
    explicit RecordedSupply(std::vector<traces::VisitChunk> chunks) {
        for (traces::VisitChunk& chunk : chunks) {
            chunks_.push_back(std::make_shared<const traces::VisitChunk>(std::move(chunk)));
        }
    }
    std::optional<SuppliedRay> next() override {
        if (chunk_ < chunks_.size() && ray_ == chunks_[chunk_]->rays.size()) ++chunk_, ray_ = 0;
        if (chunk_ == chunks_.size()) return std::nullopt;
        return SuppliedRay{{}, {chunks_[chunk_], ray_++}};
    }
    [[nodiscard]] double share() const override { return 0; }

  private:
    std::vector<std::shared_ptr<const traces::VisitChunk>> chunks_;
    std::size_t chunk_ = 0;
    std::uint32_t ray_ = 0;
};

TEST_P(Machine, ReplaysRecordedTraversalsWithTheSameHitsCyclesAndCounters) {
    for (const model::BvhOptions options :
         {model::BvhOptions{4, 1}, {2, 1}, {8, 3}, {6, 1, model::NodeFormat::Quantised}}) {
        const auto image = test::image_of(test::triangle_soup(800, 3, 0.15F), options);
        auto rays = test::rays_into_unit_cube(1100, 4);
        rays[17].direction = {0, 0, 0};  // cannot hit anything, and is not traversed
        for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
            const MachineResult computed = simulate(config_, image, rays, kind);
            RecordedSupply supply(
                traces::record_visits({"w", kind, traces::IdKind::None, 0, rays, {}}, image));
            std::vector<std::optional<model::Hit>> hits;
            MachineResult replayed =
                simulate(config_, image, supply, kind, [&](const auto& hit) { hits.push_back(hit); });
            replayed.hits = std::move(hits);
            expect_equal(computed, replayed);
        }
    }
}

TEST_P(Machine, IsNeverFasterThanItsUnitsAllow) {
    const auto image = test::image_of(test::triangle_soup(800, 3, 0.15F));
    const auto rays = test::rays_into_unit_cube(500, 7);
    const MachineResult result = simulate(config_, image, rays, RayKind::ClosestHit);
    const std::uint64_t rtus = config_.rtu.count;
    EXPECT_GE(result.cycles * config_.host.rays_per_cycle, rays.size());
    EXPECT_GE(result.cycles * rtus * config_.rtu.box.boxes_per_cycle, result.counts.box_tests);
    const std::uint64_t issues =
        config_.rtu.pair.mode == PairMode::Single ? result.counts.triangle_tests : result.counts.pair_tests;
    EXPECT_GE(result.cycles * rtus * config_.rtu.pair.testers, issues * config_.rtu.pair.ii_cycles);
    std::uint64_t held = 0;
    for (const UnitResult& unit : result.units) {
        if (unit.name.ends_with("pair")) held += counter(result.units, unit.name, "hit_unit_cycles");
    }
    EXPECT_GE(result.cycles * rtus * config_.rtu.pair.testers * config_.rtu.pair.hit_units, held);
}

INSTANTIATE_TEST_SUITE_P(Variants, Machine, testing::ValuesIn(variants),
                         [](const auto& test) { return std::string(test.param.name); });

// What the hit units add to a lone ray: two cycles of queue, and their work.
std::uint64_t hit_unit_cycles(const Config::Rtu::Pair& config, const model::MemoryImage& image,
                              const model::Ray& ray) {
    std::uint64_t cycles = 0;
    model::Traversal traversal;
    for (bool goes_on = model::start(traversal, image, ray, RayKind::ClosestHit); goes_on;
         goes_on = model::pop(traversal)) {
        if (!traversal.current.ref.is_leaf()) {
            (void)model::visit_node(traversal, image);
            continue;
        }
        const model::PairVisit visit = model::visit_pair(traversal, image, 0);
        if (visit.exact_tests == 0) continue;
        cycles += 2 + visit.better_hits * config.hit_cycles +
                  (visit.exact_tests - visit.better_hits) * config.reject_cycles +
                  visit.side_tests * config.side_cycles;
    }
    return cycles;
}

// One slot, everything cached: each step costs the latencies of its two units and one register for each of
// three channels.
TEST(MachineLatency, OfOneRayIsTheSumOfItsSteps) {
    Config config;
    config.rtu.ray_slots = 1;
    const auto image = test::image_of(test::triangle_soup(64, 9, 0.3F));
    int in_hit_units = 0;
    for (const model::Ray& ray : test::rays_into_unit_cube(20, 10)) {
        model::TraversalCounts counts;
        (void)model::trace(image, ray, RayKind::ClosestHit, &counts);
        const auto cycles = [&](std::size_t copies) {
            return simulate(config, image, std::vector(copies, ray), RayKind::ClosestHit).cycles;
        };
        // The third ray finds in the L1 what the first two have brought there.
        const std::uint64_t node_step = config.l1.latency_cycles + config.rtu.box.latency_cycles +
                                        config.rtu.scheduler.latency_cycles + 3;
        const std::uint64_t leaf_step = config.l1.latency_cycles + config.rtu.pair.latency_cycles +
                                        config.rtu.scheduler.latency_cycles + 3;
        const std::uint64_t hits = hit_unit_cycles(config.rtu.pair, image, ray);
        EXPECT_EQ(cycles(3) - cycles(2),
                  1 + counts.node_visits * node_step + counts.pair_tests * leaf_step + hits);
        in_hit_units += hits > 0 ? 1 : 0;
    }
    EXPECT_GT(in_hit_units, 10);
}

// The first ray finds nothing in the L1: every visit waits for a flat memory once, and nothing is in its way.
TEST(MachineLatency, OfOneColdRayAddsAFlatMemorysForEachVisit) {
    Config config;
    config.memory = {MemoryModel::Flat, 37, 1024};
    const auto image = test::image_of(test::triangle_soup(64, 9, 0.3F));
    for (const model::Ray& ray : test::rays_into_unit_cube(20, 10)) {
        model::TraversalCounts counts;
        (void)model::trace(image, ray, RayKind::ClosestHit, &counts);
        const std::uint64_t node_step = config.l1.latency_cycles + config.rtu.box.latency_cycles +
                                        config.rtu.scheduler.latency_cycles + 3;
        const std::uint64_t leaf_step = config.l1.latency_cycles + config.rtu.pair.latency_cycles +
                                        config.rtu.scheduler.latency_cycles + 3;
        const std::uint64_t miss = 2 + 1 + config.memory.latency_cycles;
        EXPECT_EQ(simulate(config, image, std::vector{ray}, RayKind::ClosestHit).cycles,
                  4 + counts.node_visits * (node_step + miss) + counts.pair_tests * (leaf_step + miss) +
                      hit_unit_cycles(config.rtu.pair, image, ray));
    }
}

// Rays that test one node each and hit nothing: one a cycle enters, and one a cycle leaves.
TEST(MachineThroughput, IsOneRayACycleAtItsPeak) {
    const auto image = test::image_of(test::triangle_soup(2, 11, 0.1F));
    constexpr std::size_t count = 20'000;
    const std::vector<model::Ray> rays(count, {{5, 5, 5}, 0, {1, 0, 0}, 1e30F});
    const MachineResult result = simulate({}, image, rays, RayKind::ClosestHit);
    EXPECT_EQ(result.counts.node_visits, count);
    EXPECT_GE(result.cycles, count);
    EXPECT_LE(result.cycles, count + 1'000);  // filling and draining: one DRAM access and one ray's latency
}

TEST(MachineThroughput, OfABoxBoundMachineIsThatOfItsLanes) {
    Config config;
    config.rtu.box.boxes_per_cycle = 1;
    const auto image = test::image_of(test::triangle_soup(800, 3, 0.15F));
    const auto rays = test::rays_into_unit_cube(4'000, 12);
    const MachineResult result = simulate(config, image, rays, RayKind::ClosestHit);
    EXPECT_LE(double(result.cycles), 1.02 * double(result.counts.box_tests));
}

TEST(MachineModes, OrderAsTheirHardwareDoes) {
    Config config;
    config.rtu.box.boxes_per_cycle = 32;  // so that the pair unit is the limit
    config.rtu.pair.ii_cycles = 8;
    config.rtu.pair.hit_units = 0;
    const auto image = test::image_of(test::closed_sphere(24, {0.5F, 0.5F, 0.5F}, 0.4F));
    const auto rays = test::rays_into_unit_cube(2'000, 13);
    const auto cycles = [&](PairMode mode) {
        config.rtu.pair.mode = mode;
        return simulate(config, image, rays, RayKind::ClosestHit).cycles;
    };
    const Cycle single = cycles(PairMode::Single), independent = cycles(PairMode::DualIndependent),
                shared = cycles(PairMode::DualShared);
    EXPECT_GT(single, independent + independent / 2);
    EXPECT_GE(shared, independent);
    EXPECT_LT(shared, independent + independent / 10);
}

TEST(MachineStack, SpillsAndReloadsWhatItCannotHold) {
    Config config;
    const auto image = test::image_of(test::triangle_soup(2'000, 14, 0.3F));
    const auto rays = test::rays_into_unit_cube(300, 15);
    config.rtu.stack_entries = 64;
    const MachineResult large = simulate(config, image, rays, RayKind::ClosestHit);
    config.rtu.stack_entries = 2;
    const MachineResult small = simulate(config, image, rays, RayKind::ClosestHit);
    EXPECT_EQ(counter(large.units, "scheduler", "spilled_entries"), 0U);
    EXPECT_GT(counter(small.units, "scheduler", "spilled_entries"), 1'000U);
    EXPECT_EQ(counter(small.units, "scheduler", "spilled_entries"),
              counter(small.units, "scheduler", "reloaded_entries"));
    EXPECT_GT(small.cycles, large.cycles);
    EXPECT_EQ(small.hits, large.hits);
    EXPECT_EQ(small.counts, large.counts);
}

TEST(MachineRays, ThatCannotHitPassThrough) {
    const auto image = test::image_of(test::triangle_soup(50, 16));
    std::vector<model::Ray> rays = test::rays_into_unit_cube(10, 17);
    for (std::size_t i = 0; i < rays.size(); i += 2) rays[i].direction = {0, 0, 0};
    const MachineResult result = simulate({}, image, rays, RayKind::ClosestHit);
    for (std::size_t i = 0; i < rays.size(); i += 2) EXPECT_FALSE(result.hits[i]);
}

TEST(MachineRays, MayBeNone) {
    const auto image = test::image_of(test::triangle_soup(50, 16));
    const MachineResult none = simulate({}, image, {}, RayKind::ClosestHit);
    EXPECT_EQ(none.cycles, 0U);
    // The same units and counters as with rays, so that reports keep their columns; all of them 0.
    const MachineResult some = simulate({}, image, test::rays_into_unit_cube(1, 1), RayKind::ClosestHit);
    ASSERT_EQ(none.units.size(), some.units.size());
    ASSERT_EQ(none.memory.size(), some.memory.size());
    for (std::size_t i = 0; i < none.units.size(); ++i) {
        EXPECT_EQ(none.units[i].cycles.total(), 0U) << none.units[i].name;
        ASSERT_EQ(none.units[i].counters.size(), some.units[i].counters.size()) << none.units[i].name;
        for (const CounterValue& counter : none.units[i].counters)
            EXPECT_EQ(counter.value, 0U) << counter.name;
    }
}

TEST(MachineMemory, FootprintDecidesWhatReachesDram) {
    const auto image = test::image_of(test::triangle_soup(2'000, 18, 0.1F));
    const auto rays = test::rays_into_unit_cube(2'000, 19);
    Config config;
    const MachineResult cached = simulate(config, image, rays, RayKind::ClosestHit);
    // Nothing is fetched from DRAM twice while the image fits the L2.
    EXPECT_LE(counter(cached.memory, "dram", "read_bytes"), image.size_bytes());
    config.l2.size_bytes = 16 * 1024;
    const MachineResult thrashing = simulate(config, image, rays, RayKind::ClosestHit);
    EXPECT_GT(counter(thrashing.memory, "dram", "read_bytes"), 2 * image.size_bytes());
    EXPECT_GT(thrashing.cycles, cached.cycles);
}

TEST(MachineMemory, FlatTakesThePlaceOfL2AndDram) {
    const auto image = test::image_of(test::triangle_soup(800, 18, 0.1F));
    const auto rays = test::rays_into_unit_cube(500, 19);
    Config config;
    config.memory.model = MemoryModel::Flat;
    config.l1 = {2048, 128, 32, 16, 1, 16, 16, 20};  // one set, so that none is full before the bus is
    const MachineResult wide = simulate(config, image, rays, RayKind::ClosestHit);
    ASSERT_EQ(wide.memory.size(), 2U);  // the L1 and the memory
    EXPECT_EQ(counter(wide.memory, "l1", "bytes_from_below"), counter(wide.memory, "memory", "read_bytes"));
    config.memory.bytes_per_cycle = 2;
    const MachineResult narrow = simulate(config, image, rays, RayKind::ClosestHit);
    EXPECT_EQ(narrow.hits, wide.hits);
    // Bound by its bandwidth. The last request may still be on the bus.
    const std::uint64_t busy = counter(narrow.memory, "memory", "bus_busy_cycles");
    EXPECT_LE(busy, narrow.cycles + config.l1.line_bytes / config.memory.bytes_per_cycle);
    EXPECT_GE(double(busy), 0.99 * double(narrow.cycles));
    // What a flat machine does not have cannot matter.
    config.l2 = {}, config.dram = {};
    EXPECT_EQ(simulate(config, image, rays, RayKind::ClosestHit).cycles, narrow.cycles);
}

}  // namespace
}  // namespace rtu::sim
