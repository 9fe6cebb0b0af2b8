#include "study/report/report_text.hpp"

#include <fmt/format.h>

#include <array>

#include "study/report/report_link.hpp"
#include "study/report/report_sections.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

std::string text(model::Vec3 v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

std::string extra_leaves(const BvhFacts& bvh) {
    if (bvh.extra_leaf_count == 0) return {};
    const double pairs = double(bvh.leaf_count - bvh.extra_leaf_count);
    return fmt::format(" (+{} % by spatial splits)", fixed(100 * double(bvh.extra_leaf_count) / pairs, 1));
}

std::string facts(const SceneReport& report) {
    const auto& [name, triangle_count, vertex_count, degenerate_count] = report.scene;
    std::string out = fmt::format("{}\n{}\n", name, std::string(name.size(), '='));
    const auto line = [&out](std::string_view label, const std::string& value) {
        out += fmt::format("  {:<9}{}\n", label, value);
    };
    const bool has_picture = report.resolution.width > 0;
    line("Run", fmt::format("rtusim {}, preset {}", report.version, report.preset) +
                    (has_picture ? fmt::format(", seed {}, {} x {} pixels", report.seed,
                                               report.resolution.width, report.resolution.height)
                                 : ""));
    if (report.rays_file) line("Rays", "from " + *report.rays_file);
    line("Inputs", fmt::format("scene {}, configuration {}", report.input_hash, config_hash(report)));
    line("Scene", fmt::format("{} triangles ({} degenerate), {} vertices", grouped(triangle_count),
                              grouped(degenerate_count), grouped(vertex_count)));
    if (has_picture) {
        line("Camera",
             fmt::format("{}: eye {}, target {}, tan half fov {:.4g}", report.camera_source,
                         text(report.camera.eye), text(report.camera.target), report.camera.tan_half_fov));
    }
    const PairingFacts& pairing = report.pairing;
    line("Pairing", fmt::format("{} by {}: {} % of the triangles paired ({} pairs, {} single)",
                                pairing.method, pairing.edge_identity, fixed(pairing.paired_percent, 2),
                                grouped(pairing.pair_count), grouped(pairing.single_count)));
    const BvhFacts& bvh = report.bvh;
    line("BVH",
         fmt::format("{} wide, {} nodes, {} leaves{}, {} in memory", bvh.width, grouped(bvh.node_count),
                     grouped(bvh.leaf_count), extra_leaves(bvh), byte_size(bvh.image_bytes)));
    return out;
}

std::string host(const SceneReport& report) {
    const HostFacts& host = report.host;
    return fmt::format(
        "\nHost (varies from run to run)\n"
        "  Simulation {} CPU s for {} rays: {} rays per CPU second\n"
        "  Pairing {} ms, BVH {} ms, whole scene {} CPU s, peak memory {}\n",
        fixed(host.cpu_seconds, 2), grouped(host.simulated_rays), fixed(simulated_rays_per_second(host), 0),
        fixed(1e3 * report.pairing.seconds, 1), fixed(1e3 * report.bvh.build_seconds, 1),
        fixed(host.total_cpu_seconds, 2), byte_size(host.peak_rss_bytes));
}

std::string check(const CheckReport& check) {
    return fmt::format(
        "\nCheck: {}\n"
        "  {} hits compared with the reference traversal: {} differ\n"
        "  {} compared with Embree: {} differ; besides {} ties\n"
        "  By the exact test Embree is wrong in {} more, and in {} of those the simulated hit is too\n",
        check.is_clean() ? "clean" : "FAILED", grouped(check.compared), grouped(check.mismatches),
        grouped(check.embree_compared), grouped(check.embree_mismatches), grouped(check.ties),
        grouped(check.embree_wrong), grouped(check.both_wrong));
}

std::string overview(std::span<const SceneReport> reports) {
    std::vector<TextTable::Column> columns{{"Scene", TextTable::Align::Left},
                                           {"Triangles"},
                                           {"Paired\n%"},
                                           {"Box tests\nper ray"},
                                           {"Pair tests\nper ray"}};
    for (const WorkloadReport& workload : reports.front().workloads)
        columns.push_back({workload.name + "\nMRPS"});
    columns.push_back({"total\nMRPS"});
    TextTable table(columns);
    for (const SceneReport& report : reports) {
        const WorkloadReport sum = total(report);
        std::vector<std::string> row{report.scene.name, grouped(report.scene.triangle_count),
                                     fixed(report.pairing.paired_percent, 2),
                                     per(sum.box_tests, sum.ray_count), per(sum.pair_tests, sum.ray_count)};
        for (const WorkloadReport& workload : report.workloads) {
            row.push_back(fixed(mrps(workload.ray_count, workload.cycles, report.clock_mhz), 1));
        }
        row.push_back(fixed(mrps(sum.ray_count, sum.cycles, report.clock_mhz), 1));
        table.add_row(row);
    }
    return fmt::format("Overview (MRPS at {} MHz)\n{}", grouped(reports.front().clock_mhz), table.text());
}

}  // namespace

std::string text_report(std::span<const SceneReport> reports) {
    std::string out;
    for (const SceneReport& report : reports) {
        out += facts(report);
        out += "\nWorkloads\n" + workload_table(report);
        out += "\nCycles of each unit, % of the workload's cycles\n" + unit_table(report);
        out += "\nRays in flight, stack and replays\n" + event_table(report);
        out += "\nCaches\n" + cache_table(report);
        out += fmt::format("\n{}\n{}", main_memory_title(report), main_memory_table(report));
        out += link_section(report);
        if (report.check) out += check(*report.check);
        out += host(report) + "\n";
    }
    if (reports.size() > 1) out += overview(reports);
    return out;
}

}  // namespace rtu::study
