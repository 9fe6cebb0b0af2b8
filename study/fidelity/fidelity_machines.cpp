#include "study/fidelity/fidelity_machines.hpp"

#include <functional>

namespace rtu::study {

std::vector<sim::Config> ranked_machines(const sim::Config& base) {
    std::vector<sim::Config> machines;
    for (const std::uint32_t lanes : {1U, 2U, 4U, 8U}) {
        for (const std::uint32_t slots : {32U, 128U}) {
            for (const std::uint32_t kibibytes : {16U, 64U}) {
                sim::Config& config = machines.emplace_back(base);
                config.rtu.box.boxes_per_cycle = lanes;
                config.rtu.ray_slots = slots;
                config.l1.size_bytes = kibibytes * 1024;
            }
        }
    }
    const auto add = [&](const std::function<void(sim::Config&)>& change) {
        change(machines.emplace_back(base));
    };
    add([](sim::Config& c) { c.rtu.pair.ii_cycles = 8; });
    add([](sim::Config& c) { c.l1.banks = 1; });
    add([](sim::Config& c) { c.l2.latency_cycles = 300; });
    add([](sim::Config& c) { c.dram.bytes_per_cycle = 1; });
    return machines;
}

}  // namespace rtu::study
