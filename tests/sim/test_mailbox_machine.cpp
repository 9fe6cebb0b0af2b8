#include <gtest/gtest.h>

#include <memory>

#include "machine_fixture.hpp"
#include "model/error.hpp"
#include "sim/effective_config.hpp"
#include "traces/visit_recorder.hpp"

namespace rtu::sim {
namespace {

using model::RayKind;

constexpr model::BvhOptions spatial{.width = 4, .splits = SplitKind::Spatial, .split_budget_percent = 200};

model::TriangleMesh split_mesh() { return test::needles(600, 3, {0.5F, 0.5F, 0.5F}); }

// Half of them through the middle of a triangle.
std::vector<model::Ray> rays_of(std::uint32_t count, std::uint32_t seed) {
    const model::TriangleMesh mesh = split_mesh();
    std::vector<model::Ray> rays = test::rays_into_unit_cube(count, seed);
    test::Random random(seed);
    for (std::size_t i = 0; i < rays.size(); i += 2) {
        const model::Triangle& triangle = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
        model::Vec3 middle;
        for (const std::uint32_t corner : triangle) middle = middle + mesh.positions[corner] * (1.0F / 3);
        rays[i].direction = middle - rays[i].origin;
    }
    return rays;
}

std::vector<model::MailboxOptions> mailboxes() {
    return {{MailboxKind::Recent, 0},
            {MailboxKind::Recent, 1},
            {MailboxKind::Recent, 8},
            {MailboxKind::Hashed, 4},
            {MailboxKind::PerPair, 0}};
}

Config machine_with(model::MailboxOptions mailbox, Config config = {}) {
    config.bvh.splits = SplitKind::Spatial;
    config.rtu.mailbox = mailbox;
    return config;
}

std::uint64_t scheduler_counter(const MachineResult& result, std::string_view name) {
    for (const UnitResult& unit : result.units) {
        for (const CounterValue& counter : unit.counters) {
            if (unit.name == "scheduler" && counter.name == name) return counter.value;
        }
    }
    ADD_FAILURE() << "no counter " << name;
    return 0;
}

void expect_equal(const MachineResult& a, const MachineResult& b) {
    EXPECT_EQ(a.cycles, b.cycles);
    EXPECT_EQ(a.counts, b.counts);
    ASSERT_EQ(a.units.size(), b.units.size());
    for (std::size_t i = 0; i < a.units.size(); ++i) {
        EXPECT_EQ(a.units[i].cycles, b.units[i].cycles) << a.units[i].name;
        for (std::size_t k = 0; k < a.units[i].counters.size(); ++k) {
            EXPECT_EQ(a.units[i].counters[k].value, b.units[i].counters[k].value)
                << a.units[i].name << " " << a.units[i].counters[k].name;
        }
    }
}

TEST(MailboxMachine, GivesTheReferencesHitsAndCounts) {
    const auto mesh = split_mesh();
    const auto image = test::image_of(mesh, spatial), plain = test::image_of(mesh);
    ASSERT_TRUE(image.has_shared_pairs());
    const auto rays = rays_of(80, 4);
    std::uint64_t saved = 0, duplicates = 0;
    for (const Config& base : {Config{}, test::tiny_machine()}) {
        for (const model::MailboxOptions& options : mailboxes()) {
            for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
                const MachineResult result = simulate(machine_with(options, base), image, rays, kind);
                model::TraversalCounts counts;
                model::TraversalStack stack;
                model::Mailbox mailbox(options);
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    ASSERT_EQ(result.hits[i], trace(stack, mailbox, image, rays[i], kind, &counts));
                    const auto without = model::trace(plain, rays[i], kind);
                    ASSERT_EQ(result.hits[i].has_value(), without.has_value());
                    if (kind == RayKind::ClosestHit) {
                        ASSERT_EQ(result.hits[i], without);
                    }
                }
                EXPECT_EQ(result.counts, counts);
                saved += counts.mailbox_hits;
                duplicates += counts.duplicate_tests;
            }
        }
    }
    EXPECT_GT(saved, 300U);
    EXPECT_GT(duplicates, 300U);
}

TEST(MailboxMachine, CountsEveryLeafOnce) {
    const auto image = test::image_of(split_mesh(), spatial);
    const auto rays = rays_of(150, 5);
    for (const model::MailboxOptions& options : mailboxes()) {
        const MachineResult result = simulate(machine_with(options), image, rays, RayKind::ClosestHit);
        const auto counter = [&](std::string_view name) { return scheduler_counter(result, name); };
        const std::uint64_t lookups = counter("mailbox_lookups"), hits = counter("mailbox_hits");
        EXPECT_EQ(lookups, options.is_on() ? hits + counter("leaf_fetches") : 0);
        EXPECT_EQ(hits, result.counts.mailbox_hits);
        EXPECT_EQ(counter("duplicate_tests"), result.counts.duplicate_tests);
        EXPECT_EQ(counter("mailbox_bytes_saved"), 64 * hits);
        const bool is_in_memory = options.kind == MailboxKind::PerPair;
        EXPECT_EQ(counter("mailbox_bytes_read"), is_in_memory ? 4 * lookups : 0);
        EXPECT_EQ(counter("mailbox_bytes_written"), is_in_memory ? 4 * (lookups - hits) : 0);
        if (is_in_memory) {
            EXPECT_EQ(result.counts.duplicate_tests, 0U);
        }
    }
}

TEST(MailboxMachine, GivesTheSameInBothClockModes) {
    const auto image = test::image_of(split_mesh(), spatial);
    const auto rays = rays_of(20, 6);
    for (const model::MailboxOptions& options : mailboxes()) {
        for (const Config& base : {Config{}, test::tiny_machine()}) {
            const Config config = machine_with(options, base);
            expect_equal(simulate(config, image, rays, RayKind::ClosestHit, ClockMode::Fast),
                         simulate(config, image, rays, RayKind::ClosestHit, ClockMode::Verify));
        }
    }
}

// The rays of one chunk of recorded traversals.
class ChunkSupply final : public RaySupply {
  public:
    explicit ChunkSupply(traces::VisitChunk chunk)
        : chunk_(std::make_shared<const traces::VisitChunk>(std::move(chunk))) {}
    std::optional<SuppliedRay> next() override {
        if (ray_ == chunk_->rays.size()) return std::nullopt;
        return SuppliedRay{{}, {chunk_, ray_++}};
    }
    [[nodiscard]] double share() const override { return 0; }

  private:
    std::shared_ptr<const traces::VisitChunk> chunk_;
    std::uint32_t ray_ = 0;
};

// A recording has no mailbox, so that one of a tree does for all.
TEST(MailboxMachine, ReplaysOneRecordingWithAnyMailbox) {
    const auto image = test::image_of(split_mesh(), spatial);
    const auto rays = rays_of(150, 7);
    for (const RayKind kind : {RayKind::ClosestHit, RayKind::AnyHit}) {
        for (const model::MailboxOptions& options : mailboxes()) {
            const Config config = machine_with(options);
            auto chunks = traces::record_visits({"w", kind, traces::IdKind::None, 0, rays, {}}, image);
            ASSERT_EQ(chunks.size(), 1U);
            ChunkSupply supply(std::move(chunks[0]));
            std::vector<std::optional<model::Hit>> hits;
            const MachineResult replayed =
                simulate(config, image, supply, kind, [&](const auto& hit) { hits.push_back(hit); });
            const MachineResult computed = simulate(config, image, rays, kind);
            expect_equal(computed, replayed);
            EXPECT_EQ(hits, computed.hits);
        }
    }
}

TEST(MailboxMachine, TakesNoCycleWhereEveryPairIsInOneLeaf) {
    const auto image = test::image_of(test::triangle_soup(500, 8, 0.2F));
    const auto rays = test::rays_into_unit_cube(200, 9);
    Config config;
    const MachineResult without = simulate(config, image, rays, RayKind::ClosestHit);
    config.rtu.mailbox = {MailboxKind::Recent, 8};
    const MachineResult with = simulate(config, image, rays, RayKind::ClosestHit);
    EXPECT_EQ(with.cycles, without.cycles);
    EXPECT_EQ(with.counts, without.counts);
    EXPECT_EQ(with.hits, without.hits);
}

// A known leaf costs a decision more and saves a visit, whose data was in the L1.
TEST(MailboxLatency, OfAKnownLeafIsOneDecision) {
    const auto image = test::image_of(split_mesh(), spatial);
    const auto rays = rays_of(150, 10);
    int compared = 0;
    for (const std::uint32_t latency : {0U, 3U}) {
        Config config;
        config.bvh.splits = SplitKind::Spatial;
        config.rtu.scheduler.latency_cycles = latency;
        config.rtu.stack_entries = 64;
        config.rtu.pair.mode = PairMode::DualIndependent;
        config.rtu.pair.hit_units = 0;
        const std::uint32_t visit = config.l1.latency_cycles + config.rtu.pair.latency_cycles + latency + 3;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::span<const model::Ray> one(&rays[i], 1);
            config.rtu.mailbox = {MailboxKind::Recent, 16};
            const MachineResult with = simulate(config, image, one, RayKind::ClosestHit);
            if (with.counts.mailbox_hits == 0) continue;
            config.rtu.mailbox = {};
            const MachineResult without = simulate(config, image, one, RayKind::ClosestHit);
            EXPECT_EQ(without.cycles - with.cycles, with.counts.mailbox_hits * (visit - (latency + 1)));
            ++compared;
        }
    }
    EXPECT_GT(compared, 20);
}

TEST(MailboxConfig, RefusesWhatCannotBe) {
    const auto load = [](std::vector<std::string> sets) {
        return load_config("default", std::nullopt, sets);
    };
    EXPECT_NO_THROW((void)load({"bvh.splits=spatial", "rtu.mailbox.entries=16"}));
    EXPECT_NO_THROW((void)load({"rtu.mailbox.kind=hashed", "rtu.mailbox.entries=8"}));
    EXPECT_NO_THROW((void)load({"rtu.mailbox.kind=hashed"}));
    EXPECT_THROW((void)load({"bvh.splits=spatial", "bvh.max_leaf_pairs=2"}), Error);
    EXPECT_THROW((void)load({"bvh.splits=spatial", "bvh.node_format=quantised"}), Error);
    EXPECT_THROW((void)load({"bvh.splits=spatial", "bvh.builder=morton"}), Error);
    EXPECT_NO_THROW((void)load({"bvh.builder=morton", "bvh.node_format=quantised"}));
    EXPECT_THROW((void)load({"rtu.mailbox.kind=hashed", "rtu.mailbox.entries=6"}), Error);
    EXPECT_THROW((void)load({"rtu.mailbox.entries=17"}), Error);
    EXPECT_THROW((void)load({"bvh.splits=both"}), Error);
}

}  // namespace
}  // namespace rtu::sim
