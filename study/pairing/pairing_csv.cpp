#include <fmt/format.h>

#include "study/csv.hpp"
#include "study/pairing/pairing_json.hpp"
#include "study/pairing/pairing_study.hpp"

namespace rtu::study {
namespace {

using CsvCells = std::vector<std::string>;

std::string number(std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; }

CsvCells run_names(std::string_view prefix) {
    CsvCells cells;
    for (const char* name :
         {"rays", "hits", "node_visits", "box_tests", "pair_tests", "triangle_tests", "cycles", "mrps",
          "image_bytes", "l1_misses", "l2_misses", "dram_bytes", "bound_by", "bound_percent"}) {
        cells.push_back(fmt::format("{}_{}", prefix, name));
    }
    return cells;
}

CsvCells run_cells(const PairingRun& run) {
    const PartUse& bound = busiest(run.uses);
    CsvCells cells;
    for (const std::uint64_t count :
         {run.total.ray_count, run.total.hit_count, run.total.node_visits, run.total.box_tests,
          run.total.pair_tests, run.total.triangle_tests, run.total.cycles}) {
        cells.push_back(fmt::format("{}", count));
    }
    cells.push_back(fmt::format("{}", run.mrps()));
    for (const std::uint64_t count : {run.bvh.image_bytes, run.l1_misses, run.l2_misses, run.dram_bytes}) {
        cells.push_back(fmt::format("{}", count));
    }
    cells.push_back(bound.part);
    cells.push_back(fmt::format("{}", bound.percent));
    return cells;
}

// Empty for other methods.
CsvCells compression_cells(const std::optional<model::CompressionCost>& cost) {
    if (!cost) return CsvCells(6);
    CsvCells cells;
    for (const std::uint64_t count : {cost->exact_candidates, cost->candidates, cost->wrong_candidates,
                                      cost->lost_candidates, cost->exact_pairs, cost->pairs}) {
        cells.push_back(fmt::format("{}", count));
    }
    return cells;
}

void append(CsvCells& cells, const CsvCells& more) { cells.insert(cells.end(), more.begin(), more.end()); }

CsvCells header() {
    CsvCells cells{"study", "setting", "x", "scene", "method", "baseline"};
    for (const PairingColumn& column : pairing_columns()) {
        if (!column.is_host_time) cells.emplace_back(column.key);
    }
    append(cells, run_names("old"));
    append(cells, run_names("new"));
    for (const char* name :
         {"exact_candidates", "candidates", "wrong_candidates", "lost_candidates", "exact_pairs", "pairs"}) {
        cells.push_back(fmt::format("compression_{}", name));
    }
    return cells;
}

// `where` is study, setting, x.
CsvCells cells_of(CsvCells where, const PairingRow& row) {
    append(where, {row.scene, row.method, row.baseline});
    for (const PairingColumn& column : pairing_columns()) {
        if (!column.is_host_time) where.push_back(number(column.value(row)));
    }
    append(where, run_cells(row.before));
    append(where, run_cells(row.after));
    append(where, compression_cells(row.compression));
    return where;
}

}  // namespace

std::string pairing_csv(const PairingReport& report) {
    std::string out = csv_line(header());
    for (const PairingRow& row : report.rows) out += csv_line(cells_of({"", "", ""}, row));
    for (const PairingStudyTable& study : report.studies) {
        for (const PairingPoint& point : study.points) {
            out += csv_line(
                cells_of({std::string(info(study.kind).name), point.setting, number(point.x)}, point.row));
        }
    }
    return out;
}

}  // namespace rtu::study
