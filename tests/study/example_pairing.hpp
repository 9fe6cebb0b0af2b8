#pragma once

#include "study/pairing/pairing_report.hpp"
#include "study/pairing/pairing_study.hpp"

namespace rtu::test {

/// A measurement with a different number in every place; `scale` tells two apart.
inline study::PairingRun example_pairing_run(const std::string& method, std::uint64_t scale) {
    study::PairingRun run;
    run.pairing = {method, "position", 50.0 + double(scale), 100, 20, 0.5 * double(scale)};
    run.bvh = {4, "full", 128, 10, 20, 1000 * scale, 0.25 * double(scale)};
    run.clock_mhz = 1000;
    run.total.ray_count = 600;
    run.total.hit_count = 300;
    run.total.node_visits = 50 * scale;
    run.total.box_tests = 200 * scale;
    run.total.pair_tests = 30 * scale;
    run.total.triangle_tests = 40 * scale;
    run.total.cycles = 1200 * scale;
    run.l1_misses = 70 * scale;
    run.l2_misses = 60 * scale;
    run.dram_bytes = 5000 * scale;
    run.uses = {{"host", 5}, {"scheduler", 20}, {"box", 80.0 + double(scale)}, {"pair", 40}, {"l1", 30},
                {"l2", 10},  {"dram", 83.5}};
    return run;
}

/// edge_bbsa against window:2: everything halves.
inline study::PairingRow example_pairing_row(const std::string& scene,
                                             const std::string& method = "edge_bbsa") {
    return {scene,   method, "window:2", example_pairing_run("window:2", 4), example_pairing_run(method, 2),
            nullptr, {},     {}};
}

/// Two scenes, two methods and one study of each kind of chart.
inline study::PairingReport example_pairing_report() {
    study::PairingReport report;
    report.version = "1.2.3";
    report.preset = "default";
    report.config_hash = "fedcba9876543210";
    report.config = {{"clock_mhz", std::uint64_t{1000}}};
    report.clock_mhz = 1000;
    report.seed = 7;
    report.resolution = {64, 32};
    report.workloads = {"primary", "ao"};
    report.edge_identity = "position";
    report.baseline = "window:2";
    report.methods = {"edge_bbsa", "window:4"};
    for (const char* scene : {"bunny", "hall"}) {
        study::PairingScene& measured = report.scenes.emplace_back();
        measured.facts = {scene, 69630, 34817, 12};
        measured.input_hash = "0123456789abcdef";
        measured.camera_source = "automatic";
        for (const std::string& method : report.methods) {
            report.rows.push_back(example_pairing_row(scene, method));
        }
    }
    report.rows.front().published = study::find_published("bunny");
    report.rows.front().mesh = study::mesh_identity("bunny", 69630);
    for (const study::PairingStudyInfo& study : study::pairing_studies()) {
        study::PairingStudyTable table{study.kind, {}};
        for (const char* scene : {"bunny", "hall"}) {
            for (const double x : {2.0, 4.0}) {
                const bool is_numeric = !study.axis.empty();
                table.points.push_back(
                    {is_numeric ? "at " + std::to_string(int(x)) : "point" + std::to_string(int(x)),
                     is_numeric ? std::optional(x) : std::nullopt, example_pairing_row(scene)});
            }
        }
        if (study.kind == study::PairingStudyKind::Window) {
            table.points.push_back({"-", std::nullopt, example_pairing_row("bunny")});
        }
        report.studies.push_back(table);
    }
    return report;
}

}  // namespace rtu::test
