#include "study/sweep/sweep_schema.hpp"

#include <fmt/format.h>

#include "sim/config_keys.hpp"
#include "study/sweep/sqlite.hpp"
#include "study/sweep/sweep_point.hpp"

namespace rtu::study {
namespace {

bool is_number(const sim::ConfigKey& key) {
    return std::holds_alternative<std::uint32_t>(sim::config_value({}, key));
}

std::string design_table() {
    std::string text =
        "CREATE TABLE design(id TEXT PRIMARY KEY, preset TEXT NOT NULL, pairing TEXT NOT NULL,"
        " edge_identity TEXT NOT NULL";
    for (const sim::ConfigKey& key : sim::config_keys()) {
        text += fmt::format(", {} {} NOT NULL", sql_name(key.name), is_number(key) ? "INTEGER" : "TEXT");
    }
    return text + ", mgates REAL NOT NULL, sram_mbits REAL NOT NULL) WITHOUT ROWID;\n";
}

std::string result_table() {
    std::string text =
        "CREATE TABLE result(point TEXT NOT NULL REFERENCES point(id), workload TEXT NOT NULL, level TEXT "
        "NOT "
        "NULL, cycles_low REAL NOT NULL, cycles_high REAL";
    for (const SweepCount& count : sweep_counts()) text += fmt::format(", {} INTEGER", count.name);
    return text + ", PRIMARY KEY(point, workload)) WITHOUT ROWID;\n";
}

// One row for each workload of each point that is done, with all that is known of it.
std::string results_view() {
    std::string text =
        "CREATE VIEW results AS SELECT p.number, p.id AS point, p.design, p.scene, p.scene_hash, p.rays,"
        " p.fidelity, p.tolerance, p.version, p.paired_percent, d.preset, d.pairing, d.edge_identity";
    for (const sim::ConfigKey& key : sim::config_keys())
        text += fmt::format(", d.{0} AS {0}", sql_name(key.name));
    text += ", d.mgates, d.sram_mbits, r.workload, r.level, r.cycles_low, r.cycles_high";
    for (const SweepCount& count : sweep_counts()) text += fmt::format(", r.{}", count.name);
    return text +
           ",\n 1.0 * r.ray_count / r.cycles * d.clock_mhz AS mrps,"
           "\n coalesce(1.0 * r.ray_count / r.cycles_high * d.clock_mhz, 0.0) AS mrps_low,"
           "\n 1.0 * r.ray_count / r.cycles_low * d.clock_mhz AS mrps_high,"
           "\n 1.0 * r.ray_count / r.cycles * d.clock_mhz / d.mgates AS mrps_per_mgate,"
           "\n coalesce(1.0 * r.ray_count / r.cycles_high * d.clock_mhz / d.mgates, 0.0)"
           " AS mrps_per_mgate_low,"
           "\n 1.0 * r.ray_count / r.cycles_low * d.clock_mhz / d.mgates AS mrps_per_mgate_high,"
           "\n 1.0 * (r.dram_read_bytes + r.dram_write_bytes) / r.ray_count AS bytes_per_ray,"
           "\n 100.0 * r.box_tests / (r.cycles * d.\"rtu.box.boxes_per_cycle\" * d.\"rtu.count\")"
           " AS box_utilisation,"
           "\n 100.0 * r.pair_tester_cycles / (r.cycles * d.\"rtu.pair.testers\" * d.\"rtu.count\")"
           " AS pair_utilisation,"
           "\n 100.0 * r.l1_hits / r.l1_line_reads AS l1_hit_percent,"
           "\n 100.0 * r.l2_hits / r.l2_line_reads AS l2_hit_percent"
           "\nFROM result r JOIN point p ON p.id = r.point JOIN design d ON d.id = p.design;\n";
}

// Of each design in each scene the rows of its most exact point: every ray if that is done, else an estimate.
std::string answers_view() {
    return "CREATE VIEW answers AS SELECT * FROM results r WHERE number IS NOT NULL AND (fidelity = 'cycle'"
           " OR NOT EXISTS (SELECT 1 FROM point p WHERE p.design = r.design AND p.scene = r.scene AND"
           " p.fidelity = 'cycle' AND p.status = 'done' AND p.number IS NOT NULL));\n";
}

}  // namespace

std::string sweep_schema() {
    return "CREATE TABLE sweep(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;\n" + design_table() +
           "CREATE TABLE point(id TEXT PRIMARY KEY, number INTEGER UNIQUE, design TEXT NOT NULL REFERENCES "
           "design(id), scene TEXT NOT NULL, scene_hash TEXT NOT NULL, rays TEXT NOT NULL, fidelity TEXT NOT "
           "NULL, tolerance REAL, version TEXT NOT NULL, status TEXT NOT NULL DEFAULT 'waiting' CHECK "
           "(status IN ('waiting', "
           "'done', 'failed')), error TEXT, paired_percent REAL) WITHOUT ROWID;\n" +
           "CREATE INDEX point_design ON point(design, scene);\n" + result_table() +
           "CREATE TABLE front(design TEXT PRIMARY KEY REFERENCES design(id)) WITHOUT ROWID;\n"
           "CREATE TABLE host(point TEXT PRIMARY KEY REFERENCES point(id), completions INTEGER NOT NULL,"
           " cpu_seconds REAL NOT NULL) WITHOUT ROWID;\n"
           "CREATE TABLE journal(name TEXT PRIMARY KEY, bytes INTEGER NOT NULL) WITHOUT ROWID;\n" +
           results_view() + answers_view() +
           fmt::format("PRAGMA application_id = {};\nPRAGMA user_version = {};\n", sweep_application_id,
                       sweep_schema_version);
}

}  // namespace rtu::study
