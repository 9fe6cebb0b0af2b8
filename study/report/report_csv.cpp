#include "study/report/report_csv.hpp"

#include <fmt/format.h>

#include <vector>

#include "study/csv.hpp"

namespace rtu::study {
namespace {

using Row = std::vector<std::string>;

Row header(const WorkloadReport& example) {
    Row row{"scene",          "workload",      "preset",    "pairing",   "edge_identity",  "seed",
            "width_pixels",   "height_pixels", "clock_mhz", "triangles", "paired_percent", "bvh_width",
            "image_bytes",    "rays",          "hits",      "box_tests", "node_visits",    "pair_tests",
            "triangle_tests", "cycles",        "mrps"};
    for (const auto* units : {&example.units, &example.memory}) {
        for (const UnitReport& unit : *units) {
            for (const char* state : {"busy", "starved", "blocked", "idle"}) {
                row.push_back(fmt::format("{}.{}_cycles", unit.name, state));
            }
            for (const CounterValue& counter : unit.counters) {
                row.push_back(fmt::format("{}.{} [{}]", unit.name, counter.name, counter.unit));
            }
        }
    }
    return row;
}

Row cells(const SceneReport& report, const WorkloadReport& workload) {
    const auto number = [](auto value) { return fmt::format("{}", value); };
    Row row{report.scene.name,
            workload.name,
            report.preset,
            report.pairing.method,
            report.pairing.edge_identity,
            number(report.seed),
            number(report.resolution.width),
            number(report.resolution.height),
            number(report.clock_mhz),
            number(report.scene.triangle_count),
            number(report.pairing.paired_percent),
            number(report.bvh.width),
            number(report.bvh.image_bytes),
            number(workload.ray_count),
            number(workload.hit_count),
            number(workload.box_tests),
            number(workload.node_visits),
            number(workload.pair_tests),
            number(workload.triangle_tests),
            number(workload.cycles),
            number(mrps(workload.ray_count, workload.cycles, report.clock_mhz))};
    for (const auto* units : {&workload.units, &workload.memory}) {
        for (const auto& [name, cycles, counters] : *units) {
            for (const std::uint64_t value : {cycles.busy, cycles.starved, cycles.blocked, cycles.idle}) {
                row.push_back(number(value));
            }
            for (const CounterValue& counter : counters) row.push_back(number(counter.value));
        }
    }
    return row;
}

}  // namespace

std::string csv_report(std::span<const SceneReport> reports) {
    const Row names = header(reports.front().workloads.front());
    std::string out = csv_line(names);
    for (const SceneReport& report : reports) {
        for (const WorkloadReport& workload : report.workloads) out += csv_line(cells(report, workload));
        Row sum = cells(report, total(report));
        sum.resize(names.size());  // the total has no units: their columns stay empty
        out += csv_line(sum);
    }
    return out;
}

}  // namespace rtu::study
