#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "study/report/run_report.hpp"
#include "study/validate/validate_output.hpp"

namespace rtu::study {
namespace {

std::vector<ValidateRow> rows_of(const ValidateReport& report, const std::string& config,
                                 const std::string& scene = {}) {
    std::vector<ValidateRow> rows;
    std::ranges::copy_if(report.rows, std::back_inserter(rows), [&](const ValidateRow& row) {
        return row.config == config && (scene.empty() || row.scene == scene);
    });
    return rows;
}

std::string sets_of(const ValidateConfig& config) {
    return config.sets.empty() ? "-" : fmt::format("{}", fmt::join(config.sets, " "));
}

std::string signed_percent(double value) { return fmt::format("{:+.2f}", value); }

StudyTable config_table(const ValidateReport& report) {
    StudyTable table{
        .title = "Error of the simulator's cycles by machine, all scenes and workloads",
        .note =
            "Worst and median of the absolute errors; base: docs/validation.md. Rays a second are of "
            "the host.",
        .columns = {{"Machine", left_aligned},
                    {"Rows"},
                    {"Worst\n%"},
                    {"Median\n%"},
                    {"RTL\nrays/s"},
                    {"Simulator\nrays/s"},
                    {"Faster\ntimes"},
                    {"Differs from base in", left_aligned}},
        .rows = {}};
    for (const ValidateConfig& config : report.configs) {
        const std::vector<ValidateRow> rows = rows_of(report, config.name);
        if (rows.empty()) continue;
        const ErrorSummary errors = error_summary(rows);
        double rays = 0, rtl = 0, sim = 0;
        for (const ValidateRow& row : rows) {
            rays += double(row.rays);
            rtl += row.rtl_cpu_seconds;
            sim += row.sim_cpu_seconds;
        }
        table.rows.push_back({config.name, grouped(errors.rows), fixed(errors.worst_percent, 2),
                              fixed(errors.median_percent, 2), rtl > 0 ? fixed(rays / rtl, 0) : "-",
                              sim > 0 ? fixed(rays / sim, 0) : "-", fixed(speedup(rows), 0),
                              sets_of(config)});
    }
    return table;
}

StudyTable row_table(const ValidateReport& report) {
    StudyTable table{
        .title = "Every run",
        .note =
            "Error: (simulator - RTL) / RTL cycles. Open sides: triangles that the first pass could "
            "neither reject nor prove hit.",
        .columns = {{"Scene", left_aligned},
                    {"Machine", left_aligned},
                    {"Workload", left_aligned},
                    {"Rays"},
                    {"RTL\ncycles"},
                    {"Simulator\ncycles"},
                    {"Error\n%"},
                    {"Open\nsides"},
                    {"RTL\nMRPS"},
                    {"Simulator\nMRPS"}},
        .rows = {}};
    const ValidateRow* last = nullptr;
    for (const ValidateRow& row : report.rows) {
        const bool is_new_scene = last == nullptr || last->scene != row.scene;
        const bool is_new_config = is_new_scene || last->config != row.config;
        if (last != nullptr && is_new_scene) table.rows.emplace_back();
        table.rows.push_back({is_new_scene ? row.scene : "", is_new_config ? row.config : "", row.workload,
                              grouped(row.rays), grouped(row.rtl_cycles), grouped(row.sim_cycles),
                              signed_percent(row.error_percent()), grouped(row.side_tests),
                              fixed(mrps(row.rays, row.rtl_cycles, row.clock_mhz), 1),
                              fixed(mrps(row.rays, row.sim_cycles, row.clock_mhz), 1)});
        last = &row;
    }
    return table;
}

}  // namespace

std::string validate_answer(const ValidateReport& report) {
    if (report.difference) {
        const ValidateDifference& it = *report.difference;
        const std::string ray = it.ray ? fmt::format(", ray {}", *it.ray) : std::string();
        return fmt::format("The RTL differs from the simulator: {}, {}, {}{}: {}.", it.scene, it.config,
                           it.workload, ray, it.what);
    }
    const ErrorSummary errors = error_summary(report.rows);
    const ExactRows exact = exact_rows(report.rows);
    return fmt::format(
        "All hits and counts of {} runs are the same in both. The simulator's cycles are off by {:.2f} % at "
        "most, {:.2f} % in the median; {} of {} runs are within 2 %. It is {:.0f} times faster.\n"
        "{} runs meet no triangle with open sides; of these, {} take exactly the cycles of the RTL.",
        errors.rows, errors.worst_percent, errors.median_percent, errors.within_2_percent, errors.rows,
        speedup(report.rows), exact.without_side_tests, exact.exact);
}

std::vector<StudyTable> validate_tables(const ValidateReport& report) {
    if (report.rows.empty()) return {};
    return {config_table(report), row_table(report)};
}

std::vector<AnyChart> validate_charts(const ValidateReport& report) {
    if (report.rows.empty()) return {};
    Chart chart;
    chart.name = "validate_errors";
    chart.title = "Cycles of the simulator against the RTL, all workloads of a scene together";
    chart.y_label = "error, %";
    std::vector<std::string> scenes;
    for (const ValidateRow& row : report.rows) {
        if (std::ranges::find(scenes, row.scene) == scenes.end()) scenes.push_back(row.scene);
    }
    for (const ValidateConfig& config : report.configs) chart.groups.push_back(config.name);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        ChartSeries& series = chart.series.emplace_back();
        series.name = scenes[i];
        series.colour = i;
        for (std::size_t k = 0; k < report.configs.size(); ++k) {
            ValidateRow sum;
            for (const ValidateRow& row : rows_of(report, report.configs[k].name, scenes[i])) {
                sum.rtl_cycles += row.rtl_cycles;
                sum.sim_cycles += row.sim_cycles;
            }
            series.points.emplace_back(double(k), sum.error_percent());
        }
    }
    return {chart};
}

}  // namespace rtu::study
