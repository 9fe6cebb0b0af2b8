#include "study/report/report_sections.hpp"

#include <algorithm>

#include "study/text_table.hpp"

namespace rtu::study {
namespace {

bool has(const std::vector<CounterValue>& counters, std::string_view name) {
    return std::any_of(counters.begin(), counters.end(),
                       [&](const CounterValue& c) { return c.name == name; });
}

std::uint64_t value_of(const std::vector<CounterValue>& counters, std::string_view name) {
    const auto found =
        std::find_if(counters.begin(), counters.end(), [&](const CounterValue& c) { return c.name == name; });
    return found == counters.end() ? 0 : found->value;
}

// One counter added over all units: several RTUs have several of each.
std::uint64_t unit_sum(const WorkloadReport& workload, std::string_view name) {
    std::uint64_t sum = 0;
    for (const UnitReport& unit : workload.units) sum += value_of(unit.counters, name);
    return sum;
}

std::string mebibytes(std::uint64_t bytes) { return fixed(double(bytes) / (1024 * 1024), 2); }

std::vector<std::string> workload_row(const WorkloadReport& workload, std::uint32_t clock_mhz) {
    return {workload.name,
            grouped(workload.ray_count),
            percent(workload.hit_count, workload.ray_count),
            per(workload.node_visits, workload.ray_count),
            per(workload.box_tests, workload.ray_count),
            per(workload.pair_tests, workload.ray_count),
            per(workload.triangle_tests, workload.ray_count),
            grouped(workload.cycles),
            fixed(mrps(workload.ray_count, workload.cycles, clock_mhz), 1)};
}

}  // namespace

std::string workload_table(const SceneReport& report) {
    TextTable table({{"Workload", left_aligned},
                     {"Rays"},
                     {"Hits\n%"},
                     {"Nodes\nper ray"},
                     {"Box tests\nper ray"},
                     {"Pair tests\nper ray"},
                     {"Tri tests\nper ray"},
                     {"Cycles"},
                     {"MRPS at\n" + grouped(report.clock_mhz) + " MHz"}});
    for (const WorkloadReport& workload : report.workloads)
        table.add_row(workload_row(workload, report.clock_mhz));
    table.add_rule();
    table.add_row(workload_row(total(report), report.clock_mhz));
    return table.text();
}

std::string unit_table(const SceneReport& report) {
    TextTable table({{"Workload", left_aligned},
                     {"Unit", left_aligned},
                     {"Busy\n%"},
                     {"Starved\n%"},
                     {"Blocked\n%"},
                     {"Idle\n%"}});
    for (const WorkloadReport& workload : report.workloads) {
        std::string label = workload.name;
        for (const auto* units : {&workload.units, &workload.memory}) {
            for (const auto& [name, cycles, counters] : *units) {
                const std::uint64_t all = cycles.total();
                table.add_row({label, name, percent(cycles.busy, all), percent(cycles.starved, all),
                               percent(cycles.blocked, all), percent(cycles.idle, all)});
                label.clear();  // once for each workload
            }
        }
    }
    return table.text();
}

std::string event_table(const SceneReport& report) {
    TextTable table({{"Workload", left_aligned},
                     {"In flight\nrays, mean"},
                     {"Spilled\nentries"},
                     {"Reloaded\nentries"},
                     {"Replays\npair tests"},
                     {"Hit units\nheld, mean"},
                     {"Wait for them\ncycles, mean"}});
    for (const WorkloadReport& workload : report.workloads) {
        table.add_row({workload.name, per(unit_sum(workload, "slot_cycles"), workload.cycles),
                       grouped(unit_sum(workload, "spilled_entries")),
                       grouped(unit_sum(workload, "reloaded_entries")),
                       grouped(unit_sum(workload, "replays")),
                       per(unit_sum(workload, "hit_unit_cycles"), workload.cycles),
                       per(unit_sum(workload, "hit_wait_cycles"), unit_sum(workload, "survivors"))});
    }
    return table.text();
}

std::string cache_table(const SceneReport& report) {
    TextTable table({{"Workload", left_aligned},
                     {"Cache", left_aligned},
                     {"Line reads"},
                     {"Hit\n%"},
                     {"Merged\n%"},
                     {"Missed\n%"},
                     {"Read\nMiB"},
                     {"From below\nMiB"},
                     {"Read, bytes\nper cycle"}});
    for (const WorkloadReport& workload : report.workloads) {
        std::string label = workload.name;
        for (const auto& [name, cycles, counters] : workload.memory) {
            if (!has(counters, "line_reads")) continue;
            const std::uint64_t reads = value_of(counters, "line_reads");
            const std::uint64_t bytes = value_of(counters, "bytes_read");
            table.add_row({label, name, grouped(reads), percent(value_of(counters, "hits"), reads),
                           percent(value_of(counters, "mshr_merges"), reads),
                           percent(value_of(counters, "misses"), reads), mebibytes(bytes),
                           mebibytes(value_of(counters, "bytes_from_below")), per(bytes, workload.cycles)});
            label.clear();
        }
    }
    return table.text();
}

std::string_view main_memory_title(const SceneReport& report) {
    for (const WorkloadReport& workload : report.workloads) {
        for (const auto& [name, cycles, counters] : workload.memory) {
            if (has(counters, "row_hits")) return "DRAM";
        }
    }
    return "Memory";
}

std::string main_memory_table(const SceneReport& report) {
    TextTable table({{"Workload", left_aligned},
                     {"Memory", left_aligned},
                     {"Reads"},
                     {"Writes"},
                     {"Row hits\n%"},
                     {"Moved\nMiB"},
                     {"Moved, bytes\nper cycle"},
                     {"Bandwidth\nGB/s"}});
    for (const WorkloadReport& workload : report.workloads) {
        for (const auto& [name, cycles, counters] : workload.memory) {
            if (!has(counters, "read_bytes")) continue;
            const std::uint64_t reads = value_of(counters, "reads"), writes = value_of(counters, "writes");
            const std::uint64_t bytes = value_of(counters, "read_bytes") + value_of(counters, "write_bytes");
            // Bytes per cycle times MHz is MB/s.
            table.add_row(
                {workload.name, name, grouped(reads), grouped(writes),
                 has(counters, "row_hits") ? percent(value_of(counters, "row_hits"), reads + writes) : "-",
                 mebibytes(bytes), per(bytes, workload.cycles),
                 fixed(mrps(bytes, workload.cycles, report.clock_mhz) / 1e3, 2)});
        }
    }
    return table.text();
}

}  // namespace rtu::study
