#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "study/stability/stability_run.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

using Align = TextTable::Align;

// A count per million rays in at most five characters: "0", "0.4", "12", "4.6k", "120k", "1.0M".
std::string per_million(std::uint64_t count, std::uint64_t rays) {
    if (rays == 0) return "-";
    const double value = 1e6 * double(count) / double(rays);
    if (count == 0) return "0";
    if (value < 9.95) return fmt::format("{:.1f}", value);
    if (value < 999.5) return fmt::format("{:.0f}", value);
    if (value < 9.95e3) return fmt::format("{:.1f}k", value * 1e-3);
    return value < 999.5e3 ? fmt::format("{:.0f}k", value * 1e-3) : fmt::format("{:.1f}M", value * 1e-6);
}

// Three digits: "0.63", "14", "1.5e+05".
std::string ulps(std::optional<double> value) {
    if (!value) return "-";
    return *value < 0.001 ? "0"
           : *value < 1e5 ? fmt::format("{:.3g}", *value)
                          : fmt::format("{:.1e}", *value);
}

std::string ulps_max(const ErrorHistogram& errors) { return errors.count() > 0 ? ulps(errors.max()) : "-"; }

struct Column {
    const char* header;
    bool Measured::*shown;
    std::string (*cell)(const Tally& tally);
};

constexpr std::array<Column, 17> columns{{
    {"Leaks", &Measured::crossings, [](const Tally& t) { return per_million(t.leaks, t.rays); }},
    {"Doubles", &Measured::doubles, [](const Tally& t) { return per_million(t.doubles, t.rays); }},
    {"Parity\nerrors", &Measured::crossings,
     [](const Tally& t) { return per_million(t.parity_errors, t.rays); }},
    {"False\nhits", &Measured::triangles, [](const Tally& t) { return per_million(t.false_hits, t.rays); }},
    {"False\nmisses", &Measured::triangles,
     [](const Tally& t) { return per_million(t.false_misses, t.rays); }},
    {"Wrong\nowners", &Measured::triangles,
     [](const Tally& t) { return per_million(t.wrong_owners, t.rays); }},
    {"Non-\nfinite", &Measured::triangles, [](const Tally& t) { return per_million(t.non_finite, t.rays); }},
    {"Self-\nhits", &Measured::self_hits, [](const Tally& t) { return per_million(t.self_hits, t.rays); }},
    {"Changed\nanswers", &Measured::variants,
     [](const Tally& t) { return per_million(t.variant_errors, t.rays); }},
    {"Order\nerrors", &Measured::order, [](const Tally& t) { return per_million(t.order_errors, t.rays); }},
    {"Culled\nhits", &Measured::boxes, [](const Tally& t) { return per_million(t.box_errors, t.rays); }},
    {"t ulp\np50", &Measured::triangles, [](const Tally& t) { return ulps(t.t_ulp.quantile(0.5)); }},
    {"t ulp\np99", &Measured::triangles, [](const Tally& t) { return ulps(t.t_ulp.quantile(0.99)); }},
    {"t ulp\np99.9", &Measured::triangles, [](const Tally& t) { return ulps(t.t_ulp.quantile(0.999)); }},
    {"t ulp\nmax", &Measured::triangles, [](const Tally& t) { return ulps_max(t.t_ulp); }},
    {"u, v\np99", &Measured::triangles, [](const Tally& t) { return ulps(t.uv_ulp.quantile(0.99)); }},
    {"u, v\nmax", &Measured::triangles, [](const Tally& t) { return ulps_max(t.uv_ulp); }},
}};

// Rows that are shown as one: of a method, or of a method and setting. In the order of their first row.
struct Line {
    std::string method, contraction, parameter, aim;
    Measured measured;
    Tally tally;
    std::uint64_t failed = 0;
};

Measured either(const Measured& a, const Measured& b) {
    return {a.crossings || b.crossings, a.doubles || b.doubles,   a.triangles || b.triangles,
            a.self_hits || b.self_hits, a.variants || b.variants, a.order || b.order,
            a.boxes || b.boxes};
}

std::vector<Line> lines_of(const StabilityReport& report, std::size_t case_index, bool is_by_parameter) {
    std::vector<Line> lines;
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    for (const StabilityRow& row : report.rows) {
        if (row.case_index != case_index || (row.is_comparison && !is_by_parameter)) continue;
        const auto key = std::pair(row.method, row.contraction);
        if (is_by_parameter || !known.contains(key)) {
            known[key] = lines.size();
            lines.push_back({row.method, row.contraction, row.parameter, row.aim, {}, {}, 0});
        }
        Line& line = lines[known[key]];
        line.measured = either(line.measured, row.measured);
        line.tally += row.tally;
        line.failed += failures(row.measured, row.tally);
    }
    return lines;
}

std::string case_table(const StabilityReport& report, std::size_t case_index, bool is_by_parameter) {
    const std::vector<Line> lines = lines_of(report, case_index, is_by_parameter);
    const StabilityCaseInfo& one = report.cases[case_index];
    std::string out =
        fmt::format("\nCase {}, {}: {}. Expected: {}.\n", one.number, one.name, one.title, one.check);
    if (lines.empty()) return out;
    Measured measured;
    for (const Line& line : lines) measured = either(measured, line.measured);
    std::vector<TextTable::Column> shown;
    if (is_by_parameter) shown = {{"Parameter", Align::Left}, {"Aim", Align::Left}};
    shown.insert(shown.end(), {{"Method", Align::Left}, {"Fused", Align::Left}, {"Rays"}, {"Hits"}});
    for (const Column& column : columns) {
        if (measured.*column.shown) shown.push_back({column.header});
    }
    TextTable table(shown);
    const Line* last = nullptr;
    for (const Line& line : lines) {
        const bool is_new = last == nullptr || last->parameter != line.parameter || last->aim != line.aim;
        if (is_by_parameter && is_new && last != nullptr) table.add_rule();
        std::vector<std::string> cells;
        if (is_by_parameter)
            cells = is_new ? std::vector{line.parameter, line.aim} : std::vector<std::string>(2);
        cells.insert(cells.end(),
                     {line.method, line.contraction, grouped(line.tally.rays), grouped(line.tally.hits)});
        for (const Column& column : columns) {
            if (!(measured.*column.shown)) continue;
            cells.push_back(line.measured.*column.shown ? column.cell(line.tally) : "-");
        }
        table.add_row(cells);
        last = &line;
    }
    return out + table.text();
}

// Methods by cases, some cases a table.
std::string overview(const StabilityReport& report, std::size_t begin, std::size_t end) {
    std::vector<TextTable::Column> head{{"Method", Align::Left}, {"Fused", Align::Left}};
    std::vector<std::vector<std::string>> rows;
    std::map<std::pair<std::string, std::string>, std::size_t> places;
    std::vector<std::size_t> shown;
    for (std::size_t i = begin; i < end; ++i) {
        const std::vector<Line> lines = lines_of(report, i, false);
        if (lines.empty()) continue;
        shown.push_back(i);
        std::string name = report.cases[i].name;
        const std::size_t cut = name.find('_');
        if (cut != std::string::npos) name[cut] = '\n';
        head.push_back({name});
    }
    for (const StabilityRow& row : report.rows) {
        const auto key = std::pair(row.method, row.contraction);
        if (places.try_emplace(key, rows.size()).second) rows.push_back({row.method, row.contraction});
    }
    for (const std::size_t i : shown) {
        for (auto& cells : rows) cells.emplace_back("-");
        for (const Line& line : lines_of(report, i, false)) {
            rows[places[{line.method, line.contraction}]].back() = per_million(line.failed, line.tally.rays);
        }
    }
    if (shown.empty()) return "";
    std::sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) {
        const auto place = [&](const std::string& name) { return std::ranges::find(report.methods, name); };
        return std::pair(place(a[0]), b[1]) < std::pair(place(b[0]), a[1]);
    });
    TextTable table(head);
    for (const auto& cells : rows) table.add_row(cells);
    return fmt::format("\n{}", table.text());
}

}  // namespace

std::string stability_text(const StabilityReport& report) {
    std::string out = fmt::format("rtusim {}, {}, seed {}, {} rays a setting{}\n", report.version,
                                  report.compiler, report.seed, grouped(report.rays),
                                  report.scene.empty() ? "" : fmt::format(", scene {}", report.scene));
    const bool is_single = report.cases.size() == 1;
    if (!is_single) {
        out +=
            "\nFailures per million rays: leaks and doubles, or false hits, false misses and non-finite "
            "hits,\n"
            "or what the case asks. Fused: whether the compiler may fuse a * b + c.\n";
        const std::size_t middle = (report.cases.size() + 1) / 2;
        out += overview(report, 0, middle) + overview(report, middle, report.cases.size());
    }
    out += "\nPer million rays, but rays and hits; t in units in the last place, u and v in 2^-24.\n";
    for (std::size_t i = 0; i < report.cases.size(); ++i) out += case_table(report, i, is_single);
    return out;
}

}  // namespace rtu::study
