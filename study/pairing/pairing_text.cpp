#include "study/pairing/pairing_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "study/pairing/pairing_study.hpp"
#include "study/pairing/pairing_tables.hpp"

namespace rtu::study {
namespace {

std::string text(const PairingTable& table) {
    TextTable lines(table.columns);
    for (const auto& row : table.rows) {
        if (row.empty()) {
            lines.add_rule();
        } else {
            lines.add_row(row);
        }
    }
    std::string note;
    for (std::size_t begin = 0; begin < table.note.size();) {
        const std::size_t end = std::min(table.note.find('\n', begin), table.note.size());
        note += fmt::format("  {}\n", table.note.substr(begin, end - begin));
        begin = end + 1;
    }
    return fmt::format("{}\n{}{}", table.title, lines.text(), note);
}

// No "-0.00".
std::string signed_fixed(double value) { return fmt::format("{:+.2f}", std::round(value * 100) / 100 + 0.0); }

}  // namespace

std::string pairing_cell(const PairingColumn& column, std::optional<double> value) {
    if (!value) return "-";
    if (column.is_change) return signed_fixed(*value);
    return fixed(*value, column.is_host_time ? 3 : 2);
}

std::string bound_by(const PairingRun& run) {
    const PartUse& use = busiest(run.uses);
    return fmt::format("{} {:.0f} %", use.part, use.percent);
}

std::string pairing_facts(const PairingReport& report) {
    std::string out = fmt::format(
        "rtusim {}, preset {}, configuration {}, seed {}, {} x {} pixels\n"
        "Rays: {}. Corners are one vertex by {}. Baseline: {}.\n",
        report.version, report.preset, report.config_hash, report.seed, report.resolution.width,
        report.resolution.height, fmt::join(report.workloads, ", "), report.edge_identity, report.baseline);
    if (report.rotation != RotationDegrees{}) {
        out += fmt::format("Scene and camera turned by {} degrees about x, y, z.\n",
                           fmt::join(report.rotation, ", "));
    }
    for (const PairingScene& scene : report.scenes) {
        out += fmt::format("Scene {}: {} triangles, hash {}, camera {}. Pre-scan: {}.\n", scene.facts.name,
                           grouped(scene.facts.triangle_count), scene.input_hash, scene.camera_source,
                           scene.prescan.is_well_paired ? "paired already, leave it alone" : "pair it");
    }
    return out;
}

std::string pairing_text(const PairingReport& report) {
    std::string out = pairing_facts(report);
    for (const PairingTable& table : comparison_tables(report)) out += fmt::format("\n{}", text(table));
    for (const PairingStudyTable& study : report.studies) {
        out += fmt::format("\n{}", text(study_table(report, study)));
    }
    return out;
}

}  // namespace rtu::study
