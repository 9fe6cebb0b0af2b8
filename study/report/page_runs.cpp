#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "study/pairing/pairing_run.hpp"
#include "study/report/loaded_run.hpp"
#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"
#include "study/report/run_findings.hpp"

namespace rtu::study {
namespace {

using Cells = std::vector<PageCell>;

double ratio(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : double(part) / double(whole);
}

PageChart mrps_chart(std::span<const PageRun> runs) {
    PageChart chart;
    chart.title = "MRPS";
    chart.note = "Million rays per second at the machine's clock, by kind of ray.";
    chart.columns = {{"Run"},
                     {"Workload"},
                     {"MRPS", 2},
                     {"Clock, MHz"},
                     {"Rays"},
                     {"Hits, %", 2},
                     {"Nodes a ray", 2},
                     {"Box tests a ray", 2},
                     {"Pair tests a ray", 2},
                     {"Triangle tests a ray", 2},
                     {"Cycles"}};
    for (const auto& [report, label] : runs) {
        for (const WorkloadReport& w : report.workloads) {
            chart.rows.push_back({label, w.name, mrps(w.ray_count, w.cycles, report.clock_mhz),
                                  double(report.clock_mhz), double(w.ray_count),
                                  100 * ratio(w.hit_count, w.ray_count), ratio(w.node_visits, w.ray_count),
                                  ratio(w.box_tests, w.ray_count), ratio(w.pair_tests, w.ray_count),
                                  ratio(w.triangle_tests, w.ray_count), double(w.cycles)});
        }
    }
    chart.values = {2};
    chart.group = 1;
    chart.y_title = "MRPS";
    return chart;
}

void add_unit_rows(PageChart& chart, const WorkloadReport& workload) {
    for (const auto* units : {&workload.units, &workload.memory}) {
        for (const UnitReport& unit : *units) {
            const auto percent = [&](std::uint64_t cycles) {
                return 100 * ratio(cycles, unit.cycles.total());
            };
            chart.rows.push_back({fmt::format("{}, {}", workload.name, unit.name), percent(unit.cycles.busy),
                                  percent(unit.cycles.starved), percent(unit.cycles.blocked),
                                  percent(unit.cycles.idle), double(unit.cycles.total())});
        }
    }
}

PageChart units_chart(const PageRun& run) {
    PageChart chart;
    chart.kind = PageChart::Kind::Stack;
    chart.title = fmt::format("{}: cycles of each unit", run.label);
    chart.note =
        "Every cycle of a unit is busy (it moved work), starved (it had none), blocked (it could not move "
        "it) "
        "or idle (before its first or after its last work).";
    chart.columns = {{"Workload, unit"}, {"Busy", 2}, {"Starved", 2},
                     {"Blocked", 2},     {"Idle", 2}, {"Cycles"}};
    for (const WorkloadReport& workload : run.report.workloads) add_unit_rows(chart, workload);
    chart.values = {1, 2, 3, 4};
    chart.y_title = "% of the cycles";
    return chart;
}

PageChart use_chart(const PageRun& run) {
    PageChart chart;
    chart.title = fmt::format("{}: use of each part", run.label);
    chart.note =
        "Work done over what all parts of that kind can do in the run's cycles. A part near 100 % is the "
        "limit; "
        "when none is, rays wait.";
    chart.columns = {{"Part"}, {"Workload"}, {"Use", 2}};
    const sim::Config config = machine_of(run.report, run.label);
    for (const WorkloadReport& workload : run.report.workloads) {
        for (const PartUse& use : part_uses(std::span(&workload, 1), config))
            chart.rows.push_back({use.part, workload.name, use.percent});
    }
    chart.values = {2};
    chart.group = 1;
    chart.y_title = "% in use";
    return chart;
}

// Over all memories of that kind.
std::uint64_t memory_sum(const WorkloadReport& workload, std::string_view kind, std::string_view counter) {
    std::uint64_t sum = 0;
    for (const UnitReport& unit : workload.memory) {
        if (unit.name.substr(unit.name.rfind('.') + 1) != kind) continue;
        for (const CounterValue& value : unit.counters) sum += value.name == counter ? value.value : 0;
    }
    return sum;
}

bool has_memory(std::span<const PageRun> runs, std::string_view kind) {
    return std::ranges::any_of(runs, [&](const PageRun& run) {
        return std::ranges::any_of(run.report.workloads, [&](const WorkloadReport& workload) {
            return std::ranges::any_of(workload.memory, [&](const UnitReport& unit) {
                return unit.name.substr(unit.name.rfind('.') + 1) == kind;
            });
        });
    });
}

std::string row_label(const PageRun& run, const WorkloadReport& workload) {
    return fmt::format("{}, {}", run.label, workload.name);
}

PageChart traffic_chart(std::span<const PageRun> runs) {
    PageChart chart;
    chart.title = "Memory traffic";
    chart.note =
        "Bytes a ray that each level hands out; what a cache keeps back, the next level does not see.";
    chart.columns = {{"Run, workload"}, {"L1 reads", 1}, {"L2 reads", 1}, {"Main memory", 1}};
    for (const PageRun& run : runs) {
        for (const WorkloadReport& w : run.report.workloads) {
            std::uint64_t main = 0;
            for (const char* kind : {"dram", "memory"}) {
                main += memory_sum(w, kind, "read_bytes") + memory_sum(w, kind, "write_bytes");
            }
            chart.rows.push_back({row_label(run, w), ratio(memory_sum(w, "l1", "bytes_read"), w.ray_count),
                                  ratio(memory_sum(w, "l2", "bytes_read"), w.ray_count),
                                  ratio(main, w.ray_count)});
        }
    }
    chart.values = {1, 2, 3};
    chart.y_title = "bytes a ray";
    return chart;
}

PageChart miss_chart(std::span<const PageRun> runs) {
    PageChart chart;
    chart.title = "Cache misses";
    chart.note = "Line reads that did not find their line, those that wait for one under way included.";
    chart.columns = {{"Run, workload"}, {"L1", 2}};
    chart.values = {1};
    const bool has_l2 = has_memory(runs, "l2");
    if (has_l2) {
        chart.columns.push_back({"L2", 2});
        chart.values.push_back(2);
    }
    for (const PageRun& run : runs) {
        for (const WorkloadReport& workload : run.report.workloads) {
            Cells& row = chart.rows.emplace_back(Cells{row_label(run, workload)});
            for (const char* level : {"l1", "l2"}) {
                if (level == std::string_view("l2") && !has_l2) continue;
                const std::uint64_t reads = memory_sum(workload, level, "line_reads");
                const std::uint64_t hits = memory_sum(workload, level, "hits");
                row.push_back(
                    cell_of(reads == 0 ? std::nullopt : std::optional(100 * (1 - ratio(hits, reads)))));
            }
        }
    }
    chart.y_title = "% of line reads";
    return chart;
}

std::string facts(std::span<const PageRun> runs) {
    std::string text;
    for (const auto& [report, label] : runs) {
        text += fmt::format(
            "{}: {} triangles, {:.1f} % in pairs ({}, by {}), machine {} at {} MHz, {} x {} pixels, seed {}, "
            "rtusim "
            "{}.\n",
            label, report.scene.triangle_count, report.pairing.paired_percent, report.pairing.method,
            report.pairing.edge_identity, report.preset, report.clock_mhz, report.resolution.width,
            report.resolution.height, report.seed, report.version);
    }
    return text;
}

}  // namespace

PageSection runs_section(std::span<const PageRun> runs) {
    PageSection section;
    section.title = "Runs";
    section.note = facts(runs);
    section.charts = {mrps_chart(runs)};
    for (const PageRun& run : runs) {
        SceneReport named = run.report;
        named.scene.name = run.label;
        for (PageFinding& found : run_findings(named, machine_of(run.report, run.label)))
            section.findings.push_back(std::move(found));
        section.charts.push_back(units_chart(run));
        section.charts.push_back(use_chart(run));
    }
    section.charts.push_back(traffic_chart(runs));
    section.charts.push_back(miss_chart(runs));
    return section;
}

}  // namespace rtu::study
