#include "study/fidelity/queueing.hpp"

#include <algorithm>
#include <vector>

namespace rtu::study {

double closed_network_throughput(std::span<const double> demands, double delay, std::uint32_t customers) {
    std::vector<double> queue(demands.size(), 0);
    double throughput = 0;
    for (std::uint32_t n = 1; n <= customers; ++n) {
        double round = delay;
        for (std::size_t i = 0; i < demands.size(); ++i) round += demands[i] * (1 + queue[i]);
        if (round <= 0) return 0;
        throughput = n / round;
        for (std::size_t i = 0; i < demands.size(); ++i) {
            queue[i] = throughput * demands[i] * (1 + queue[i]);
        }
    }
    return throughput;
}

double packed_cycles_per_node(std::span<const double> nodes_with, std::uint32_t lanes) {
    double total = 0;
    for (const double count : nodes_with) total += count;
    if (total <= 0) return 0;
    // Chances of the number of lanes in use; after some nodes they depend on the first no more.
    std::vector<double> used(lanes + 1, 0);
    used[lanes] = 1;
    double cycles = 0;
    constexpr int settling = 64, nodes = 128;
    for (int node = 0; node < nodes; ++node) {
        std::vector<double> next(lanes + 1, 0);
        for (std::uint32_t children = 1; children < nodes_with.size(); ++children) {
            const double chance = nodes_with[children] / total;
            if (chance == 0) continue;
            const std::uint32_t own_cycles = (children + lanes - 1) / lanes;
            for (std::uint32_t in_use = 0; in_use <= lanes; ++in_use) {
                const bool fits = own_cycles == 1 && in_use + children <= lanes;
                // A node of several cycles shares none of them.
                next[fits ? in_use + children : own_cycles == 1 ? children : lanes] += chance * used[in_use];
                if (!fits && node >= settling) cycles += chance * used[in_use] * own_cycles;
            }
        }
        used = std::move(next);
    }
    return cycles / (nodes - settling);
}

double in_order_bank_rate(std::uint32_t banks, std::uint32_t most) {
    double rate = 0, chance = 1;
    for (std::uint32_t i = 0; i < std::min(banks, most); ++i) {
        chance *= double(banks - i) / banks;
        rate += chance;
    }
    return rate;
}

}  // namespace rtu::study
