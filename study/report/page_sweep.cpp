#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "sim/config_keys.hpp"
#include "study/report/page_cells.hpp"
#include "study/report/page_points.hpp"

namespace rtu::study {
namespace {

constexpr std::array measures{"mrps",           "bytes_per_ray",  "box_utilisation", "pair_utilisation",
                              "l1_hit_percent", "l2_hit_percent", "paired_percent",  "cycles"};

bool is_parameter(const std::string& name) {
    constexpr std::array names{"preset", "pairing", "edge_identity", "scene", "workload"};
    return std::ranges::find(names, name) != names.end() ||
           std::ranges::find(sim::config_keys(), name, &sim::ConfigKey::name) != sim::config_keys().end();
}

bool varies(const PageField& field) {
    const auto differs = [](const auto& values) {
        return std::ranges::any_of(values, [&](const auto& value) { return value != values.front(); });
    };
    return differs(field.numbers) || differs(field.names);
}

// MRPS over what else the sweep looks for, or over its first parameter that is a number.
void choose_axes(PageExplorer& explorer, const std::vector<SweepObjective>& objectives) {
    const auto first = [&](auto&& is_wanted) {
        const auto found = std::ranges::find_if(explorer.fields, is_wanted);
        return found == explorer.fields.end() ? std::string("mrps") : found->name;
    };
    explorer.y = "mrps";
    explorer.x = first([&](const PageField& field) {
        return field.name != "mrps" &&
               std::ranges::find(objectives, field.name, &SweepObjective::column) != objectives.end();
    });
    if (explorer.x == "mrps")
        explorer.x = first([](const PageField& f) { return f.is_parameter && !f.numbers.empty(); });
    if (explorer.x == "mrps")
        explorer.x = first([](const PageField& f) { return f.name == "bytes_per_ray"; });
    explorer.color = first(
        [&](const PageField& f) { return f.is_parameter && f.name != explorer.x && f.name != "workload"; });
}

std::string better(const std::string& name, const std::vector<SweepObjective>& objectives) {
    const auto objective = std::ranges::find(objectives, name, &SweepObjective::column);
    if (objective != objectives.end()) return objective->is_maximised ? "more" : "less";
    if (name == "mrps" || name.ends_with("_utilisation") || name.ends_with("_hit_percent")) return "more";
    return name == "bytes_per_ray" || name == "cycles" || is_parameter(name) ? "less" : "";
}

// Parameters that are the same everywhere say nothing.
PageExplorer explorer(PagePoints points) {
    PageExplorer result;
    for (PageField& field : points.fields) {
        field.is_parameter = is_parameter(field.name);
        field.better = field.names.empty() ? better(field.name, points.objectives) : "";
        const bool is_measure = std::ranges::find(measures, field.name) != measures.end();
        const bool is_needed = field.name == "mrps" || field.name == "design" || field.name == "front";
        if (is_needed || ((field.is_parameter || is_measure) && varies(field)))
            result.fields.push_back(std::move(field));
    }
    choose_axes(result, points.objectives);
    return result;
}

const PageField* find(const PageExplorer& explorer, std::string_view name) {
    const auto found = std::ranges::find(explorer.fields, name, &PageField::name);
    return found == explorer.fields.end() ? nullptr : &*found;
}

std::string name_at(const PageField* field, std::size_t point) {
    return field == nullptr || field->names.empty() ? std::string() : field->names[point];
}

// Misses over the size of a cache, the median of all designs of a size.
std::optional<PageChart> miss_curve(const PageExplorer& points, const std::string& level) {
    const PageField* size = find(points, level + ".size_bytes");
    const PageField* hits = find(points, level + "_hit_percent");
    if (size == nullptr || hits == nullptr) return std::nullopt;
    std::map<std::pair<std::string, double>, std::vector<double>> misses;
    for (std::size_t i = 0; i < size->numbers.size(); ++i) {
        const std::string workload = name_at(find(points, "workload"), i),
                          scene = name_at(find(points, "scene"), i);
        if (workload == "total" || !size->numbers[i] || !hits->numbers[i]) continue;
        misses[{scene.empty() ? workload : scene + ", " + workload, *size->numbers[i] / 1024}].push_back(
            100 - *hits->numbers[i]);
    }
    PageChart chart;
    chart.kind = PageChart::Kind::Lines;
    chart.title = fmt::format("Miss curve of {}", level);
    chart.note = "Line reads that do not hit, the median of all designs with a size.";
    chart.columns = {{"Rays"}, {"Size, KiB", 1}, {"Misses, %", 2}, {"Designs"}};
    for (const auto& [key, values] : misses)
        chart.rows.push_back({key.first, key.second, median_of(values), double(values.size())});
    if (chart.rows.empty()) return std::nullopt;
    chart.x = 1;
    chart.group = 0;
    chart.values = {2};
    chart.is_x_log = true;
    chart.y_title = "% of line reads";
    return chart;
}

std::string design_text(const PageExplorer& points, std::size_t point) {
    std::vector<std::string> texts;
    for (const PageField& field : points.fields) {
        if (!field.is_parameter || field.name == "workload") continue;
        texts.push_back(field.names.empty()
                            ? fmt::format("{} = {}", field.name, field.numbers[point].value_or(0))
                            : fmt::format("{} = {}", field.name, field.names[point]));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

// Of all workloads together, where there are totals.
std::vector<PageFinding> extremes(const PageExplorer& points) {
    const PageField* mrps = find(points, "mrps");
    const PageField* workload = find(points, "workload");
    std::optional<std::size_t> best, worst;
    for (std::size_t i = 0; i < mrps->numbers.size(); ++i) {
        const bool counts = workload == nullptr || name_at(workload, i) == "total";
        if (!counts || !mrps->numbers[i]) continue;
        if (!best || *mrps->numbers[i] > *mrps->numbers[*best]) best = i;
        if (!worst || *mrps->numbers[i] < *mrps->numbers[*worst]) worst = i;
    }
    if (!best) return {};
    const auto finding = [&](const char* subject, std::size_t i) {
        return PageFinding{
            subject, fmt::format("{:.2f} MRPS.", *mrps->numbers[i]), {}, design_text(points, i)};
    };
    return {finding("Fastest design", *best), finding("Slowest design", *worst)};
}

}  // namespace

PageSection points_section(PagePoints points) {
    PageSection section;
    section.title = "Sweep";
    section.note = points.note;
    section.explorer = explorer(std::move(points));
    section.findings = extremes(*section.explorer);
    for (const char* level : {"l1", "l2"}) {
        if (auto curve = miss_curve(*section.explorer, level)) section.charts.push_back(std::move(*curve));
    }
    return section;
}

}  // namespace rtu::study
