#pragma once

#include <vector>

#include "model/traversal.hpp"
#include "sim/machine.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::test {

/// Rays from outside the unit cube towards its inside: most hit something of a mesh that fills it.
inline std::vector<model::Ray> rays_into_unit_cube(std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    std::vector<model::Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 from = random.point(-1, 2), to = random.point(0, 1);
        rays.push_back({from, 0, to - from, std::numeric_limits<float>::infinity()});
    }
    return rays;
}

/// A machine small enough for its limits to be met: few slots, a short stack, little caches.
inline sim::Config tiny_machine() {
    sim::Config config;
    config.rtu.ray_slots = 4;
    config.rtu.stack_entries = 2;
    config.l1 = {1024, 64, 32, 2, 1, 2, 2, 3};
    config.l2 = {4096, 64, 32, 2, 1, 2, 2, 5};
    config.dram.channels = 1;
    config.dram.queue_entries = 2;
    return config;
}

}  // namespace rtu::test
