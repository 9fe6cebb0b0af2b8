#include <gtest/gtest.h>

#include "machine_fixture.hpp"
#include "sim/machine.hpp"

namespace rtu::sim {
namespace {

using model::NodeFormat;
using model::RayKind;

std::uint64_t counter(const MachineResult& result, std::string_view unit, std::string_view name) {
    for (const UnitResult& u : result.units) {
        for (const CounterValue& c : u.counters) {
            if (u.name == unit && c.name == name) return c.value;
        }
    }
    ADD_FAILURE() << "no counter " << unit << "." << name;
    return 0;
}

class NodeFormats : public testing::TestWithParam<std::uint32_t> {
  protected:
    NodeFormats() {
        config_.bvh.width = GetParam();
        full_ = test::image_of(mesh_, {GetParam(), 1});
        quantised_ = test::image_of(mesh_, {GetParam(), 1, NodeFormat::Quantised});
    }
    MachineResult run(NodeFormat format, RayKind kind = RayKind::ClosestHit) {
        config_.bvh.node_format = format;
        return simulate(config_, format == NodeFormat::Full ? full_ : quantised_, rays_, kind);
    }

    model::TriangleMesh mesh_ = test::triangle_soup(800, 3, 0.15F);
    std::vector<model::Ray> rays_ = test::rays_into_unit_cube(1'500, 8);
    Config config_;
    model::MemoryImage full_, quantised_;
};

TEST_P(NodeFormats, GiveTheSameHitsBitForBit) {
    const MachineResult full = run(NodeFormat::Full), quantised = run(NodeFormat::Quantised);
    EXPECT_EQ(full.hits, quantised.hits);
    const auto any_full = run(NodeFormat::Full, RayKind::AnyHit).hits;
    const auto any_quantised = run(NodeFormat::Quantised, RayKind::AnyHit).hits;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        ASSERT_EQ(any_full[i].has_value(), any_quantised[i].has_value());
    }
}

// Any-hit rays that miss take every way that could lead to a hit, whatever the order: the difference in
// visits is what the extra hits led to.
TEST_P(NodeFormats, DifferInWhatTheyEnterByTheExtraHits) {
    for (model::Ray& ray : rays_) ray.direction = ray.direction * -1.0F;  // most leave the cube
    const MachineResult full = run(NodeFormat::Full), quantised = run(NodeFormat::Quantised);
    EXPECT_EQ(counter(full, "box", "extra_box_hits"), 0U);
    std::uint64_t of_misses = 0, of_full = 0;
    for (const auto& [image, sum] : {std::pair{&quantised_, &of_misses}, std::pair{&full_, &of_full}}) {
        model::Traversal walk;
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            if (full.hits[i] || !model::start(walk, *image, rays_[i], RayKind::ClosestHit)) continue;
            do {
                if (walk.current.ref.is_leaf()) {
                    model::visit_pair(walk, *image, 0);
                    continue;
                }
                const model::NodeVisit visit = model::visit_node(walk, *image);
                *sum += visit.box_hits - visit.extra_hits;
            } while (model::pop(walk));
        }
    }
    EXPECT_EQ(of_misses, of_full);
    EXPECT_GT(counter(quantised, "box", "extra_box_hits"), 0U);
    EXPECT_EQ(counter(quantised, "box", "box_tests"), quantised.counts.box_tests);
    EXPECT_EQ(counter(quantised, "scheduler", "node_fetch_bytes"),
              quantised.counts.node_visits * quantised_.node_bytes());
    EXPECT_EQ(counter(quantised, "scheduler", "leaf_fetch_bytes"), quantised.counts.pair_tests * 64);
}

// As MachineLatency.OfOneRayIsTheSumOfItsSteps, with the cycles in which planes are made.
TEST_P(NodeFormats, AddTheirDequantisationToEachVisit) {
    config_.rtu.ray_slots = 1;
    rays_.assign(3, rays_.front());
    const std::uint64_t visits = run(NodeFormat::Quantised).counts.node_visits / 3;
    const auto third_ray = [&] {
        rays_.resize(3, rays_.front());
        const std::uint64_t three = run(NodeFormat::Quantised).cycles;
        rays_.resize(2);
        return three - run(NodeFormat::Quantised).cycles;
    };
    config_.rtu.box.dequantise_cycles = 0;
    const std::uint64_t without = third_ray();
    config_.rtu.box.dequantise_cycles = 7;
    EXPECT_EQ(third_ray(), without + 7 * visits);
}

INSTANTIATE_TEST_SUITE_P(AllWidths, NodeFormats, testing::Values(2U, 4U, 6U, 8U));

}  // namespace
}  // namespace rtu::sim
