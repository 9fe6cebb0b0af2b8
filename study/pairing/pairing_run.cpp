#include "study/pairing/pairing_run.hpp"

#include <algorithm>
#include <string_view>

namespace rtu::study {
namespace {

// "l1" of "rtu0.l1".
std::string_view kind_of(std::string_view unit_name) {
    const std::size_t dot = unit_name.rfind('.');
    return dot == std::string_view::npos ? unit_name : unit_name.substr(dot + 1);
}

// Adds one counter over all units of that kind and all workloads.
class Sums {
  public:
    explicit Sums(std::span<const WorkloadReport> workloads) : workloads_(workloads) {}

    [[nodiscard]] std::uint64_t of(std::string_view kind, std::string_view counter) const {
        std::uint64_t sum = 0;
        for (const WorkloadReport& workload : workloads_) {
            sum += of(workload.units, kind, counter) + of(workload.memory, kind, counter);
        }
        return sum;
    }
    [[nodiscard]] std::uint64_t bank_accesses(std::string_view cache) const {
        // A fill takes its bank once for each access that waited for it.
        return of(cache, "line_reads") + of(cache, "line_writes") + of(cache, "misses") +
               of(cache, "mshr_merges");
    }

  private:
    [[nodiscard]] static std::uint64_t of(const std::vector<UnitReport>& units, std::string_view kind,
                                          std::string_view counter) {
        std::uint64_t sum = 0;
        for (const UnitReport& unit : units) {
            if (kind_of(unit.name) != kind) continue;
            for (const CounterValue& value : unit.counters) sum += value.name == counter ? value.value : 0;
        }
        return sum;
    }

    std::span<const WorkloadReport> workloads_;
};

// A machine has a DRAM or a flat memory.
std::uint64_t of_main_memory(const Sums& sums, std::string_view counter) {
    return sums.of("dram", counter) + sums.of("memory", counter);
}

// Cycles of full work. With room for several nodes a cycle, a cycle with fewer counts in part.
std::uint64_t box_cycles(const Sums& sums, const sim::Config& config) {
    const std::uint64_t nodes_per_cycle = config.rtu.box.boxes_per_cycle / config.bvh.width;
    const std::uint64_t issue_cycles = sums.of("box", "issue_cycles");
    if (nodes_per_cycle < 2) return issue_cycles;
    return std::min(issue_cycles, sums.of("box", "node_visits") / nodes_per_cycle);
}

WorkloadReport sum_of(std::span<const WorkloadReport> workloads) {
    SceneReport scene;
    scene.workloads.assign(workloads.begin(), workloads.end());
    return total(scene);
}

}  // namespace

std::vector<PartUse> part_uses(std::span<const WorkloadReport> workloads, const sim::Config& config) {
    const Sums sums(workloads);
    std::uint64_t cycles = 0, rays = 0;
    for (const WorkloadReport& workload : workloads) {
        cycles += workload.cycles;
        rays += workload.ray_count;
    }
    std::vector<PartUse> uses;
    const auto add = [&](std::string_view part, std::uint64_t work, std::uint64_t a_cycle) {
        const double possible = double(cycles) * double(a_cycle);
        uses.push_back({std::string(part), possible > 0 ? 100.0 * double(work) / possible : 0.0});
    };
    const std::uint64_t rtus = config.rtu.count;
    add("host", rays, config.host.rays_per_cycle);
    add("scheduler", sums.of("scheduler", "node_fetches") + sums.of("scheduler", "leaf_fetches"),
        rtus * config.rtu.fetches_per_cycle);
    add("box", box_cycles(sums, config), rtus);
    add("pair", sums.of("pair", "tester_cycles"), rtus * config.rtu.pair.testers);
    add("hit", sums.of("pair", "hit_unit_cycles"),
        rtus * config.rtu.pair.testers * config.rtu.pair.hit_units);
    add("l1", sums.bank_accesses("l1"), rtus * config.l1.banks);
    add("l2", sums.bank_accesses("l2"), config.l2.banks);
    add("dram", of_main_memory(sums, "bus_busy_cycles"),
        config.memory.model == sim::MemoryModel::Flat ? 1 : config.dram.channels);
    return uses;
}

const PartUse& busiest(std::span<const PartUse> uses) {
    return *std::ranges::max_element(uses, {}, &PartUse::percent);
}

PairingRun pairing_run(const PairingFacts& pairing, const BvhFacts& bvh,
                       std::span<const WorkloadReport> workloads, const sim::Config& config) {
    const Sums sums(workloads);
    return {pairing,
            bvh,
            config.clock_mhz,
            sum_of(workloads),
            sums.of("l1", "misses"),
            sums.of("l2", "misses"),
            of_main_memory(sums, "read_bytes") + of_main_memory(sums, "write_bytes"),
            part_uses(workloads, config)};
}

}  // namespace rtu::study
