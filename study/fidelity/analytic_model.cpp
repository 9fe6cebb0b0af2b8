#include "study/fidelity/analytic_model.hpp"

#include <algorithm>
#include <cmath>

#include "study/fidelity/queueing.hpp"
#include "study/fidelity/unloaded_latency.hpp"

namespace rtu::study {
namespace {

double pair_cycles(const sim::Config& config, const RayWork& work) {
    const auto& pair = config.rtu.pair;
    const double issues = pair.mode == sim::PairMode::Single ? work.triangle_tests : work.pair_tests;
    return issues * pair.ii_cycles / pair.testers;
}

double box_cycles_per_node(const sim::Config& config, const WorkloadProfile& profile) {
    auto nodes_with = profile.nodes_with;
    if (config.rtu.box.packs_nodes == 0) {
        nodes_with = {};
        nodes_with[config.bvh.width] = 1;
    }
    return packed_cycles_per_node(nodes_with, config.rtu.box.boxes_per_cycle);
}

// Cycles between two rays that the host hands to one RTU.
double host_cycles(const sim::Config& config) {
    const auto rays_per_cycle = double(std::min(config.host.rays_per_cycle, config.rtu.count));
    return config.rtu.count / rays_per_cycle;
}

// Of one RTU, all of its hit units together.
double hit_cycles(const sim::Config& config, const RayWork& work) {
    const auto& pair = config.rtu.pair;
    return pair.hit_units == 0 ? 0 : hit_unit_cycles(config, work) / (pair.hit_units * pair.testers);
}

double scheduler_cycles(const sim::Config& config, const RayWork& work) {
    return (work.node_visits + work.leaf_visits) /
           std::min(config.rtu.results_per_cycle, config.rtu.fetches_per_cycle);
}

}  // namespace

double hit_unit_cycles(const sim::Config& config, const RayWork& work) {
    const auto& pair = config.rtu.pair;
    if (pair.hit_units == 0) return 0;
    return work.better_hits * pair.hit_cycles + (work.survivors - work.better_hits) * pair.reject_cycles +
           work.side_tests * pair.side_cycles;
}

std::vector<Demand> demands(const sim::Config& config, const WorkloadProfile& profile,
                            const ProfileBlock& block) {
    const RayWork& work = block.per_ray;
    const auto& rtu = config.rtu;
    const auto& l1 = config.l1;
    const auto& l2 = config.l2;
    const auto& dram = config.dram;
    const double rtus = rtu.count;
    const double l1_misses = block.l1_misses_per_ray,
                 l2_misses = block.l2_misses_per_ray + block.first_touches_per_ray;
    const double row_cycles = dram.t_rp_cycles + dram.t_rcd_cycles + dram.t_cas_cycles;
    std::vector<Demand> parts{
        {"host", host_cycles(config)},
        {"scheduler", scheduler_cycles(config, work)},
        {"box", work.node_visits * box_cycles_per_node(config, profile)},
        {"pair", pair_cycles(config, work)},
        {"l1 banks",
         block.lines_per_ray / in_order_bank_rate(l1.banks, rtu.fetches_per_cycle) + l1_misses / l1.banks},
        {"l1 mshrs", (l1_misses * l2_cycles(config) + l2_misses * dram_cycles(config)) / l1.mshrs},
    };
    if (rtu.pair.hit_units > 0) {
        parts.push_back({"hit units", hit_cycles(config, work)});
    }
    if (has_flat_memory(config)) {
        parts.push_back({"memory bus", rtus * l1_misses * flat_bus_cycles(config)});
        return parts;
    }
    parts.insert(
        parts.end(),
        {
            {"l2 banks", rtus * (l1_misses / in_order_bank_rate(l2.banks, l2.banks) + l2_misses / l2.banks)},
            {"l2 mshrs", rtus * l2_misses * dram_cycles(config) / l2.mshrs},
            {"dram bus",
             rtus * l2_misses * std::ceil(double(l2.line_bytes) / dram.bytes_per_cycle) / dram.channels},
            {"dram banks", rtus * l2_misses * row_cycles / (double(dram.channels) * dram.banks)},
        });
    return parts;
}

double unloaded_cycles(const sim::Config& config, const ProfileBlock& block) {
    const RayWork& work = block.per_ray;
    // Of every visit: three channels, for request, data and result.
    const double both = config.l1.latency_cycles + config.rtu.scheduler.latency_cycles + 3.0;
    const double to_hit_unit = config.rtu.pair.hit_units > 0 ? 2 : 0;
    return 1 + work.node_visits * (both + box_latency_cycles(config)) +
           work.leaf_visits * (both + config.rtu.pair.latency_cycles) + work.survivor_pairs * to_hit_unit +
           hit_unit_cycles(config, work) + block.l1_misses_per_ray * l2_cycles(config) +
           (block.l2_misses_per_ray + block.first_touches_per_ray) * dram_cycles(config);
}

namespace {

ProfileBlock without_misses(ProfileBlock block) {
    block.l1_misses_per_ray = block.l2_misses_per_ray = block.first_touches_per_ray = 0;
    block.held_up_cycles_per_ray = block.held_up_by_first_touches_per_ray = 0;
    return block;
}

// Of the whole machine.
double cycles_per_ray(const sim::Config& config, const WorkloadProfile& profile, const ProfileBlock& block) {
    std::vector<double> stations;
    for (const Demand& part : demands(config, profile, block)) stations.push_back(part.cycles_per_ray);
    const double throughput =
        closed_network_throughput(stations, unloaded_cycles(config, block), config.rtu.ray_slots);
    // An L1 that is held up keeps everything else waiting.
    const double held_up = block.held_up_cycles_per_ray + block.held_up_by_first_touches_per_ray;
    return (1 / throughput + held_up) / config.rtu.count;
}

void add(std::vector<Demand>& sums, const Demand& part, double rays) {
    const auto found = std::ranges::find(sums, part.unit, &Demand::unit);
    Demand& sum = found != sums.end() ? *found : sums.emplace_back(Demand{part.unit, 0});
    sum.cycles_per_ray += rays * part.cycles_per_ray;
}

}  // namespace

AnalyticResult analyse(const sim::Config& config, const WorkloadProfile& profile) {
    AnalyticResult result;
    double cycles = 0, cycles_without_misses = 0;
    std::vector<Demand> sums;
    for (const ProfileBlock& block : profile.blocks) {
        if (block.rays <= 0) continue;
        cycles += block.rays * cycles_per_ray(config, profile, block);
        cycles_without_misses += block.rays * cycles_per_ray(config, profile, without_misses(block));
        result.rays += block.rays;
        for (const Demand& part : demands(config, profile, block)) add(sums, part, block.rays);
    }
    if (result.rays <= 0) return result;
    // The first ray has nobody before it and the last nobody behind.
    const double ends = unloaded_cycles(config, profile.blocks.front()) / 2 +
                        unloaded_cycles(config, profile.blocks.back()) / 2;
    cycles += ends;
    cycles_without_misses += ends;
    result.ends_share = ends / cycles;
    result.cycles_per_ray = cycles / result.rays;
    result.memory_share = 1 - cycles_without_misses / cycles;
    result.bottleneck = std::ranges::max_element(sums, {}, &Demand::cycles_per_ray)->unit;
    return result;
}

double least_cycles(const sim::Config& config, const RayWork& work) {
    return std::max({work.rays * host_cycles(config), scheduler_cycles(config, work),
                     work.box_tests / config.rtu.box.boxes_per_cycle, pair_cycles(config, work),
                     hit_cycles(config, work)}) /
           config.rtu.count;
}

}  // namespace rtu::study
