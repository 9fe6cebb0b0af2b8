#include "study/methods/method_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/methods/method.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

using model::methods::Form;

std::string title_of_method(std::string_view name) {
    struct Named {
        std::string_view name, title;
    };
    static constexpr std::array others = std::to_array<Named>({{"rtu", "RTU, pair test"},
                                                               {"rtu_traversal", "RTU, traversal"},
                                                               {"embree", "Embree"},
                                                               {"embree_robust", "Embree, robust"}});
    for (const Named& other : others) {
        if (other.name == name) return std::string(other.title);
    }
    const model::methods::Method* method = model::methods::find_method(name);
    return std::string(method == nullptr ? name : method->info.title);
}

double per_million(std::uint64_t count, std::uint64_t of) {
    return of == 0 ? 0 : 1e6 * double(count) / double(of);
}

// Contracted code is the subject of other tables.
bool is_plain(const StabilityRow& row) { return row.contraction != "fast"; }

const std::string& case_of(const StabilityReport& report, const StabilityRow& row) {
    return report.cases[row.case_index].name;
}

// Rays from inside a ball at the world's origin, or that far from it: what errors of t are shown of.
const StabilityRow* random_rays(const StabilityReport& report, std::string_view method,
                                std::string_view offset) {
    const auto found = std::ranges::find_if(report.rows, [&](const StabilityRow& row) {
        return row.method == method && is_plain(row) && case_of(report, row) == "far_offset" &&
               row.parameter == offset && row.aim == "random";
    });
    return found == report.rows.end() ? nullptr : &*found;
}

// Whole scenes and what traverses them are asked for hits only.
bool has_errors(const StabilityReport& report, std::string_view method) {
    const StabilityRow* row = random_rays(report, method, "0");
    return row != nullptr && row->tally.t_ulp.count() > 0;
}

std::vector<std::string> methods_of(const StabilityReport& report) {
    std::vector<std::string> methods;
    for (const StabilityRow& row : report.rows) {
        if (std::ranges::find(methods, row.method) == methods.end()) methods.push_back(row.method);
    }
    return methods;
}

// Leaks of rays at edges and vertices of all closed meshes.
double leak_rate(const StabilityReport& report, std::string_view method) {
    std::uint64_t rays = 0, leaks = 0;
    for (const StabilityRow& row : report.rows) {
        const std::string& name = case_of(report, row);
        if (row.method != method || !is_plain(row) || !row.measured.crossings) continue;
        if (name != "shared_edge" && name != "shared_vertex") continue;
        rays += row.tally.rays;
        leaks += row.tally.leaks;
    }
    return per_million(leaks, rays);
}

// 0, 7, 370, 12k, 1M: what fits a cell.
std::string short_number(double value) {
    if (value == 0) return "0";
    if (value < 0.95) return "<1";
    if (value < 999.5) return fmt::format("{:.0f}", value);
    if (value < 9'950) return fmt::format("{:.1f}k", value / 1e3);
    if (value < 999'500) return fmt::format("{:.0f}k", value / 1e3);
    return fmt::format("{:.2g}M", value / 1e6);
}

ChartSeries series(std::string name, std::size_t colour) { return {std::move(name), {}, {}, {}, colour}; }

ChartSeries* find_series(std::vector<ChartSeries>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &ChartSeries::name);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace

ScatterChart speed_chart(const MethodsReport& speeds, const StabilityReport& stability) {
    ScatterChart chart;
    chart.name = "methods_speed";
    chart.title =
        fmt::format("Speed against accuracy: one ray x 8 triangles, one thread, {}", speeds.instruction_set);
    chart.x_label = "99 % of hits: error of t at most (ulp)";
    chart.y_label = "million tests a second";
    chart.colour_label = "leaks per million rays at edges and vertices";
    for (const MethodsRow& row : speeds.rows) {
        const bool is_wide = row.kernel.form == Form::Triangles && row.kernel.width == 8;
        if (!is_wide || row.workload != "random") continue;
        const StabilityRow* accuracy = random_rays(stability, row.kernel.method.name, "0");
        if (accuracy == nullptr) continue;
        const auto p99 = accuracy->tally.t_ulp.quantile(0.99);
        if (!p99) continue;
        chart.points.push_back({std::string(row.kernel.method.title), std::max(*p99, 0.5),
                                row.tests_per_second / 1e6, leak_rate(stability, row.kernel.method.name)});
    }
    const auto [least, most] = std::ranges::minmax_element(chart.points, {}, &ScatterPoint::x);
    chart.is_x_logarithmic = !chart.points.empty() && most->x > 8 * least->x;
    return chart;
}

ChartPanels offset_chart(std::span<const OffsetRow> rows) {
    ChartPanels panels;
    panels.name = "methods_offset";
    panels.title =
        "Leaks and double hits of a closed ball of radius 16, against its distance from the origin";
    std::uint64_t rays = 1;
    for (const char* aim : {"edge", "vertex"}) {
        Chart panel;
        panel.title = fmt::format("rays at {}", aim == std::string_view("edge") ? "edges" : "vertices");
        panel.x_label = "offset of the ball";
        panel.y_label = "leaks and double hits per million rays";
        panel.is_x_logarithmic = true;
        panel.x_base = 10;
        for (const OffsetRow& row : rows) {
            const std::string name = title_of_method(row.method);
            if (find_series(panel.series, name) == nullptr) {
                panel.series.push_back(series(name, panel.series.size()));
            }
            rays = std::max(rays, row.rays);
            if (row.aim != aim) continue;
            find_series(panel.series, name)
                ->points.emplace_back(row.offset, per_million(row.leaks + row.doubles, row.rays));
        }
        panels.panels.push_back(std::move(panel));
    }
    for (Chart& panel : panels.panels) panel.y_floor = 0.4e6 / double(rays);
    return panels;
}

HeatMap failure_chart(const StabilityReport& stability) {
    HeatMap map;
    map.name = "methods_cases";
    map.title = "Where methods fail: wrong answers per million rays";
    map.colour_label = "wrong answers per million rays";
    map.rows = methods_of(stability);
    std::vector<std::size_t> cases;
    for (std::size_t i = 0; i < stability.cases.size(); ++i) {
        const auto is_of_case = [i](const StabilityRow& row) {
            return row.case_index == i && is_plain(row) && row.tally.rays > 0;
        };
        if (std::ranges::any_of(stability.rows, is_of_case)) cases.push_back(i);
    }
    double least = 1e6;
    for (const std::string& method : map.rows) {
        auto& cells = map.cells.emplace_back();
        for (const std::size_t index : cases) {
            std::uint64_t rays = 0, wrong = 0;
            for (const StabilityRow& row : stability.rows) {
                if (row.method != method || row.case_index != index || !is_plain(row) || row.is_comparison)
                    continue;
                rays += row.tally.rays;
                wrong += failures(row.measured, row.tally);
            }
            const double rate = per_million(wrong, rays);
            if (rate > 0) least = std::min(least, rate);
            cells.push_back(rays == 0 ? std::nullopt
                                      : std::optional(HeatMap::Cell{rate, short_number(rate)}));
        }
    }
    for (const std::size_t index : cases) map.columns.push_back(stability.cases[index].name);
    for (std::string& row : map.rows) row = title_of_method(row);
    map.floor = std::pow(10.0, std::floor(std::log10(least)));
    return map;
}

ChartPanels error_chart(const StabilityReport& stability) {
    ChartPanels panels;
    panels.name = "methods_errors";
    panels.title = "Error of t: random rays inside a ball of radius 2";
    struct Place {
        const char* offset;
        const char* title;
    };
    for (const Place place : {Place{"0", "at the world's origin"}, Place{"1e3", "1,000 from it"}}) {
        Chart panel;
        panel.title = place.title;
        panel.x_label = "error of t at most (ulp)";
        panel.y_label = "hits (%)";
        panel.is_x_logarithmic = true;
        panel.x_base = 10;
        panel.has_points = false;
        for (const std::string& method : methods_of(stability)) {
            if (!has_errors(stability, method)) continue;
            const StabilityRow* row = random_rays(stability, method, place.offset);
            ChartSeries line = series(title_of_method(method), panel.series.size());
            for (int percent = 1; percent <= 100 && row != nullptr; ++percent) {
                const auto error = row->tally.t_ulp.quantile(percent / 100.0);
                if (error) line.points.emplace_back(std::max(*error, 0.1), percent);
            }
            panel.series.push_back(std::move(line));
        }
        panels.panels.push_back(std::move(panel));
    }
    return panels;
}

Chart operation_chart(std::span<const model::methods::MethodCounts> counts) {
    Chart chart;
    chart.name = "methods_operations";
    chart.title = "Operations of triangles that are hit, before the last division";
    chart.y_label = "multiplications and additions";
    chart.series = {series("one triangle", 4), series("two triangles", 5), series("pair, both hit", 2),
                    series("pair, one hit", 0)};
    for (const model::methods::MethodCounts& row : counts) {
        if (!row.pair) continue;
        const auto group = double(chart.groups.size());
        chart.groups.push_back(title_of_method(row.name));
        const auto& one = row.single.full;
        std::size_t i = 0;
        for (const auto& each : {one, one + one, row.pair->both_full, row.pair->one_full}) {
            chart.series[i++].points.emplace_back(group, each.mul + each.add);
        }
    }
    return chart;
}

Chart width_chart(const MethodsReport& speeds) {
    Chart chart;
    chart.name = "methods_widths";
    chart.title = fmt::format("Packets: W rays x 1 triangle, one thread, {}", speeds.instruction_set);
    chart.x_label = "rays at once (1: no packet)";
    chart.y_label = "million tests a second";
    chart.is_x_logarithmic = true;
    chart.has_zero_line = true;
    std::size_t colour = 0;
    for (const std::string_view method : width_chart_methods) {
        ChartSeries line = series(title_of_method(method), colour++);
        for (const MethodsRow& row : speeds.rows) {
            const bool is_here = row.kernel.method.name == method && row.workload == "random";
            if (!is_here || (row.kernel.form != Form::Rays && row.kernel.form != Form::Single)) continue;
            line.points.emplace_back(row.kernel.width, row.tests_per_second / 1e6);
        }
        std::ranges::sort(line.points);
        if (!line.points.empty()) chart.series.push_back(std::move(line));
    }
    for (const PublishedSpeed& published : published_speeds()) {
        if (!published.packets) continue;
        const ChartSeries* ours = find_series(chart.series, title_of_method(published.method));
        if (ours == nullptr) continue;
        ChartSeries line = series(ours->name + ", published", ours->colour + 6);
        line.points = {{1, published.single}, {4, *published.packets}};
        chart.series.push_back(std::move(line));
    }
    return chart;
}

PixelPanels parity_chart(std::span<const ParityMap> maps, std::uint32_t width, std::uint32_t height) {
    PixelPanels panels;
    panels.name = "methods_parity";
    panels.title =
        "From inside a closed mesh, every ray should hit once: rays at each edge and vertex, and between";
    panels.width = width;
    panels.height = height;
    panels.classes = {{"no hit: a leak", "#c01010"}, {"even: wrong side", "#f0c000"}, {"odd", "#b8b8b8"}};
    for (const ParityMap& map : maps) {
        PixelPanels::Panel panel{title_of_method(map.method), {}};
        std::size_t leaks = 0, even = 0;
        for (const std::uint32_t hits : map.hits) {
            panel.pixels.push_back(hits == 0 ? 0 : hits % 2 == 0 ? 1 : 2);
            leaks += hits == 0 ? 1 : 0;
            even += hits != 0 && hits % 2 == 0 ? 1 : 0;
        }
        panel.title += fmt::format(": {} red, {} yellow", grouped(leaks), grouped(even));
        panels.panels.push_back(std::move(panel));
    }
    return panels;
}

Chart precision_chart(const PrecisionReport& precision) {
    Chart chart;
    chart.name = "methods_precision";
    chart.x_label = "area of the arithmetic (binary32 multipliers; assumed proxy)";
    chart.y_label = "wrong rays per million";
    if (precision.scenes.empty()) return chart;
    const PrecisionAnswer& scene = precision.scenes.front();
    chart.title = fmt::format("Precision ladder of {}: mantissas of 7 to 23 bits, {} rays", scene.scene,
                              grouped(scene.rays));
    chart.y_floor = 0.4e6 / double(std::max<std::uint64_t>(scene.rays, 1));
    std::vector<std::string> shown{"moller_trumbore", "plucker",       "wald",         "havel_herout",
                                   "embree_plucker",  "baldwin_weber", "woop_top_left"};
    for (const auto& answer : {scene.row, scene.watertight_row}) {
        if (!answer) continue;
        const std::string& method = precision.rows[*answer].method;
        if (std::ranges::find(shown, method) == shown.end()) shown.push_back(method);
    }
    for (const std::string& method : shown) {
        ChartSeries line = series(title_of_method(method), chart.series.size());
        for (const PrecisionRow* row : ladder(precision, scene.scene, method, 8)) {
            if (row->area) line.points.emplace_back(*row->area, per_million(row->wrong(), row->rays));
        }
        if (!line.points.empty()) chart.series.push_back(std::move(line));
    }
    return chart;
}

}  // namespace rtu::study
