#pragma once

#include "study/report/run_report.hpp"

namespace rtu::test {

/// A report with a different number in every place, so that a swapped column shows.
inline study::SceneReport example_report(const std::string& name = "bunny") {
    study::SceneReport report;
    report.version = "1.2.3";
    report.input_hash = "0123456789abcdef";
    report.preset = "default";
    report.seed = 18446744073709551615ULL;
    report.resolution = {64, 32};
    report.camera = {{1, 2.5F, -3}, {0, 0.45F, 0}, {0, 1, 0}, 0.4F};
    report.camera_source = "automatic";
    report.scene = {name, 69630, 34817, 12};
    report.pairing = {"window:2", "position", 65.69, 22870, 23890, 0.0082};
    report.bvh = {4, "full", 128, 17974, 46760, 5293312, 0.1063};
    report.clock_mhz = 1500;
    report.config = {{"clock_mhz", std::uint64_t{1500}}, {"rtu.pair.mode", std::string("dual_shared")}};

    study::WorkloadReport primary;
    primary.name = "primary";
    primary.ray_count = 2048;
    primary.hit_count = 512;
    primary.box_tests = 34304;
    primary.node_visits = 8832;
    primary.pair_tests = 1024;
    primary.triangle_tests = 1983;
    primary.cycles = 9000;
    primary.units = {{"scheduler",
                      {4500, 2250, 1800, 450},
                      {{"slot_cycles", "cycles", 1080000},
                       {"spilled_entries", "entries", 77},
                       {"reloaded_entries", "entries", 66}}},
                     {"pair", {900, 8000, 0, 100}, {{"replays", "replays", 5}}}};
    primary.memory = {{"l1",
                       {9000, 0, 0, 0},
                       {{"line_reads", "accesses", 10000},
                        {"hits", "accesses", 8800},
                        {"misses", "accesses", 811},
                        {"mshr_merges", "accesses", 389},
                        {"bytes_read", "bytes", 1270784},
                        {"bytes_from_below", "bytes", 75264}}},
                      {"dram",
                       {100, 200, 300, 8400},
                       {{"reads", "requests", 588},
                        {"writes", "requests", 12},
                        {"row_hits", "requests", 300},
                        {"read_bytes", "bytes", 75264},
                        {"write_bytes", "bytes", 1536}}}};
    study::WorkloadReport shadow = primary;
    shadow.name = "shadow";
    shadow.ray_count = 512;
    shadow.cycles = 4096;
    report.workloads = {primary, shadow};
    report.check = study::CheckReport{2560, 0, 2550, 0, 3, 2, 14};
    report.host = {0.0125, 0.37, 2560, 34952192};
    return report;
}

}  // namespace rtu::test
