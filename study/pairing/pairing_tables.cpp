#include "study/pairing/pairing_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "study/pairing/pairing_study.hpp"
#include "study/pairing/pairing_text.hpp"

namespace rtu::study {
namespace {

using Keys = std::span<const std::string_view>;
using Cells = std::vector<std::string>;

constexpr auto paper_keys =
    std::to_array<std::string_view>({"seconds", "old_paired_percent", "new_paired_percent",
                                     "delta_box_percent", "delta_tri_percent", "delta_mrps_percent"});
constexpr auto memory_keys = std::to_array<std::string_view>(
    {"delta_image_bytes_percent", "delta_bvh_build_seconds_percent", "delta_l1_misses_percent",
     "delta_l2_misses_percent", "delta_dram_bytes_percent"});
constexpr auto published_keys =
    std::to_array<std::string_view>({"old_paired_percent", "new_paired_percent", "delta_box_percent",
                                     "delta_tri_percent", "delta_mrps_percent"});

// The columns of these keys for every row, and below them an average a method.
PairingTable keyed_table(const PairingReport& report, Keys keys) {
    PairingTable table{{}, {}, {{"Scene", left_aligned}, {"Method", left_aligned}}, {}};
    for (const auto key : keys) table.columns.push_back({std::string(pairing_column(key).header)});
    const auto add = [&](const std::string& scene, const std::string& method, const auto& value) {
        Cells cells{scene, method};
        for (const auto key : keys) {
            const PairingColumn& column = pairing_column(key);
            cells.push_back(pairing_cell(column, value(column)));
        }
        table.rows.push_back(cells);
    };
    for (const PairingRow& row : report.rows) {
        add(row.scene, row.method, [&](const PairingColumn& column) { return column.value(row); });
    }
    table.rows.emplace_back();
    for (const std::string& method : report.methods) {
        add("average", method,
            [&](const PairingColumn& column) { return average(report.rows, method, column); });
    }
    return table;
}

double use_of(const PairingRun& run, std::string_view part) {
    return std::ranges::find(run.uses, part, &PartUse::part)->percent;
}

PairingTable bound_table(const PairingReport& report) {
    PairingTable table;
    table.title = fmt::format("What bounds the machine, old / new (MRPS at {} MHz, use in % of the cycles)",
                              grouped(report.clock_mhz));
    table.columns = {{"Scene", left_aligned},
                     {"Method", left_aligned},
                     {"MRPS\nold"},
                     {"MRPS\nnew"},
                     {"Bound by\nold", left_aligned},
                     {"Bound by\nnew", left_aligned},
                     {"Box\nold / new"},
                     {"Pair\nold / new"},
                     {"L2\nold / new"},
                     {"DRAM\nold / new"}};
    for (const PairingRow& row : report.rows) {
        const auto uses = [&row](std::string_view part) {
            return fmt::format("{:.0f} / {:.0f}", use_of(row.before, part), use_of(row.after, part));
        };
        table.rows.push_back({row.scene, row.method, fixed(row.before.mrps(), 1), fixed(row.after.mrps(), 1),
                              bound_by(row.before), bound_by(row.after), uses("box"), uses("pair"),
                              uses("l2"), uses("dram")});
    }
    table.note =
        "Bound by: the part that is used most. Far below 100 % nothing is full: rays wait for latencies.";
    return table;
}

// No rows when nothing compressed is compared.
PairingTable compression_table(const PairingReport& report) {
    PairingTable table;
    table.title = "What 16-byte half-edges cost (edge_bbsa_compressed beside edge_bbsa)";
    table.columns = {{"Scene", left_aligned}, {"Candidates\nexact"}, {"Candidates\ncompressed"},
                     {"Wrong\ncandidates"},   {"Lost\ncandidates"},  {"Pairs\nexact"},
                     {"Pairs\ncompressed"},   {"Pairs\nchange"}};
    for (const PairingRow& row : report.rows) {
        if (!row.compression) continue;
        const model::CompressionCost& cost = *row.compression;
        table.rows.push_back(
            {row.scene, grouped(cost.exact_candidates), grouped(cost.candidates),
             grouped(cost.wrong_candidates), grouped(cost.lost_candidates), grouped(cost.exact_pairs),
             grouped(cost.pairs),
             fmt::format("{:+}", std::int64_t(cost.pairs) - std::int64_t(cost.exact_pairs))});
    }
    table.note =
        "Candidates: neighbours of the sorted table with equal keys, of two triangles. Wrong: they have no\n"
        "edge in common and are passed over. Lost: no neighbours in the compressed table.";
    return table;
}

double published_value(const PublishedRow& row, std::string_view key) {
    if (key == "old_paired_percent") return row.old_paired_percent;
    if (key == "new_paired_percent") return row.new_paired_percent;
    if (key == "delta_box_percent") return row.delta_box_percent;
    if (key == "delta_tri_percent") return row.delta_tri_percent;
    return row.delta_mrps_percent;
}

// Ours above the published row, scene by scene; no rows when nothing was published.
PairingTable published_table(const PairingReport& report) {
    PairingTable table{"Published beside ours [AF: Aman, Fenney, \"Fast Triangle Pairing for Ray Tracing\"]",
                       {},
                       {{"Scene", left_aligned}, {"Values", left_aligned}},
                       {}};
    for (const auto key : published_keys) table.columns.push_back({std::string(pairing_column(key).header)});
    for (const PairingRow& row : report.rows) {
        if (row.published == nullptr) continue;
        Cells ours{row.scene, "here"},
            theirs{row.mesh.is_papers_mesh ? "" : "(another edition)", "published"};
        for (const auto key : published_keys) {
            const PairingColumn& column = pairing_column(key);
            ours.push_back(pairing_cell(column, column.value(row)));
            theirs.push_back(pairing_cell(column, published_value(*row.published, key)));
        }
        table.rows.push_back(ours);
        table.rows.push_back(theirs);
        table.note += fmt::format("{}{}: {}.", table.note.empty() ? "" : "\n", row.scene, row.mesh.note);
    }
    if (!table.note.empty()) table.note += "\nTheir cameras, rays and machine are not published.";
    return table;
}

}  // namespace

std::vector<PairingTable> comparison_tables(const PairingReport& report) {
    std::vector<PairingTable> tables{keyed_table(report, paper_keys), keyed_table(report, memory_keys),
                                     bound_table(report)};
    tables[0].title = fmt::format("Pairing impact against {}", report.baseline);
    tables[0].note = "Tri tests are pair tests: a pair and a lone triangle take one each. Time is host time.";
    tables[1].title = fmt::format("Memory, change against {}", report.baseline);
    tables[1].note =
        "L1 misses: line reads that went on to the L2, all L1s together; L2 misses: those that went on to\n"
        "the DRAM. BVH build is host time, the lesser of two builds, and noisy.";
    PairingTable compression = compression_table(report);
    if (!compression.rows.empty()) tables.push_back(std::move(compression));
    PairingTable published = published_table(report);
    if (!published.rows.empty()) tables.push_back(std::move(published));
    return tables;
}

PairingTable study_table(const PairingReport& report, const PairingStudyTable& study) {
    const PairingStudyInfo& what = info(study.kind);
    PairingTable table;
    table.title = fmt::format("Study {}: {} (change against {})", what.name, what.meaning, report.baseline);
    table.columns = {{"Scene", left_aligned},
                     {"Setting", left_aligned},
                     {"Method", left_aligned},
                     {"Pairs\nold %"},
                     {"Pairs\nnew %"},
                     {"Box\n%"},
                     {"Tri\n%"},
                     {"MRPS\n%"},
                     {"MRPS\nold"},
                     {"MRPS\nnew"},
                     {"Bound by\nold", left_aligned},
                     {"Bound by\nnew", left_aligned}};
    std::string last_scene;
    for (const auto& [setting, x, row] : study.points) {
        if (!last_scene.empty() && row.scene != last_scene) table.rows.emplace_back();
        const auto cell = [&, &of = row](std::string_view key) {
            const PairingColumn& column = pairing_column(key);
            return pairing_cell(column, column.value(of));
        };
        table.rows.push_back({row.scene == last_scene ? "" : row.scene, setting, row.method,
                              cell("old_paired_percent"), cell("new_paired_percent"),
                              cell("delta_box_percent"), cell("delta_tri_percent"),
                              cell("delta_mrps_percent"), fixed(row.before.mrps(), 1),
                              fixed(row.after.mrps(), 1), bound_by(row.before), bound_by(row.after)});
        last_scene = row.scene;
    }
    return table;
}

}  // namespace rtu::study
