#include "study/precision/precision_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace rtu::study {
namespace {

using Column = TextTable::Column;

std::string per_million(std::uint64_t count, std::uint64_t of) {
    return of == 0 ? "-" : grouped(std::uint64_t(std::llround(1e6 * double(count) / double(of))));
}

// Errors of 0.01 to 10^30 units.
std::string ulps(std::optional<double> value) {
    if (!value) return "-";
    if (std::isinf(*value)) return "inf";
    return *value < 1e4 ? fmt::format("{:.1f}", *value) : fmt::format("{:.1e}", *value);
}

std::string area(std::optional<double> value) { return value ? fmt::format("{:.1f}", *value) : "-"; }

const PrecisionRow* row_of(const PrecisionReport& report, std::string_view scene, std::string_view method,
                           model::methods::NumberFormat format) {
    const auto found = std::ranges::find_if(report.rows, [&](const PrecisionRow& row) {
        return row.scene == scene && row.method == method && row.format == format;
    });
    return found == report.rows.end() ? nullptr : &*found;
}

const PrecisionRow* one_bit_less(const PrecisionReport& report, const PrecisionRow& row) {
    auto format = row.format;
    --format.mantissa_bits;
    return row_of(report, row.scene, row.method, format);
}

std::vector<std::string> methods_of(const PrecisionReport& report, std::string_view scene) {
    std::vector<std::string> methods;
    for (const PrecisionRow& row : report.rows) {
        const bool is_new = methods.empty() || methods.back() != row.method;
        if (row.scene == scene && is_new) methods.push_back(row.method);
    }
    return methods;
}

const std::vector<Column> measures{{"Wrong\nper M"}, {"Lost\nrays"},     {"Gained\nrays"}, {"Moved\nrays"},
                                   {"Leaks\nper M"}, {"Doubles\nper M"}, {"t p50\nulp"},   {"t p99\nulp"}};

void add_measures(const PrecisionRow& row, std::vector<std::string>& cells) {
    for (std::string& cell :
         std::vector{per_million(row.wrong(), row.rays), grouped(row.lost), grouped(row.gained),
                     grouped(row.moved), per_million(row.leaks, row.aimed_rays),
                     per_million(row.doubles, row.aimed_rays), ulps(row.t_ulp_p50), ulps(row.t_ulp_p99)}) {
        cells.push_back(std::move(cell));
    }
}

void add_narrowest(const PrecisionReport& report, const std::string& method, const PrecisionRow* row,
                   StudyTable& table) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells = {method, row == nullptr ? "none" : to_string(row->format)};
    if (row != nullptr) {
        cells.push_back(std::to_string(row->format.width_bits()));
        cells.push_back(area(row->area));
        add_measures(*row, cells);
        const PrecisionRow* less = one_bit_less(report, *row);
        if (less != nullptr) cells.push_back(per_million(less->wrong(), less->rays));
    }
    cells.resize(table.columns.size(), "-");
}

StudyTable method_table(const PrecisionReport& report, const PrecisionAnswer& scene) {
    StudyTable table{
        .title = "The narrowest format of each method that is exact enough, and every wider one too",
        .note = "",
        .columns = {{"Method", left_aligned}, {"Format", left_aligned}, {"Bits"}, {"Area"}},
        .rows = {}};
    table.columns.insert(table.columns.end(), measures.begin(), measures.end());
    table.columns.push_back({"One bit less\nwrong per M"});
    for (const std::string& method : methods_of(report, scene.scene)) {
        const PrecisionRow* narrow = narrowest_enough(ladder(report, scene.scene, method, 8));
        const PrecisionRow* wide = narrowest_enough(ladder(report, scene.scene, method, 10));
        add_narrowest(report, method, narrow, table);
        const bool is_better_wide =
            wide != nullptr &&
            (narrow == nullptr || wide->format.mantissa_bits < narrow->format.mantissa_bits);
        if (is_better_wide) add_narrowest(report, method, wide, table);
    }
    table.note =
        "Area: of the arithmetic of one test, in binary32 multipliers; assumed: multiplier (p/24)^2, adder "
        "0.3 p/24, divider\n8 (p/24)^2, p = mantissa bits + 1. `exact` decides without rounding on numbers "
        "rounded to the format: what storage costs.\nExponents have 8 bits; 10 are shown where they allow a "
        "narrower mantissa. Leaks and doubles are of rays aimed at edges and vertices.";
    return table;
}

StudyTable ladder_table(const PrecisionReport& report, const PrecisionRow& answer) {
    StudyTable table{.title = fmt::format("The ladder of {}", answer.method),
                     .note =
                         "Exact, wrong: rays that are wrong because ray and triangles were rounded to the "
                         "format, whatever the arithmetic.",
                     .columns = {{"Format", left_aligned}, {"Bits"}, {"Area"}},
                     .rows = {}};
    table.columns.insert(table.columns.end(), measures.begin(), measures.end());
    table.columns.push_back({"t max\nulp"});
    table.columns.push_back({"Exact, wrong\nper M"});
    const auto add = [&](const PrecisionRow& row) {
        table.rows.push_back(
            {to_string(row.format), std::to_string(row.format.width_bits()), area(row.area)});
        add_measures(row, table.rows.back());
        table.rows.back().push_back(ulps(row.t_ulp_max));
        const PrecisionRow* stored = row_of(report, row.scene, "exact", row.format);
        table.rows.back().push_back(stored == nullptr ? "-" : per_million(stored->wrong(), stored->rays));
    };
    for (const std::uint32_t exponent : {5U, 8U}) {
        for (const PrecisionRow* row : ladder(report, answer.scene, answer.method, exponent)) add(*row);
    }
    const PrecisionRow* wide = row_of(report, answer.scene, answer.method, {10, 23});
    if (wide != nullptr) add(*wide);
    return table;
}

StudyTable filter_table(const PrecisionReport& report, const PrecisionAnswer& scene) {
    StudyTable table{
        .title = "Quantised filters: interval arithmetic before an exact test",
        .note =
            "False positives: exactly missed tests that are passed on, of all missed. A filter must have "
            "no false negatives.",
        .columns = {{"Format", left_aligned},
                    {"Tests"},
                    {"Hits\n%"},
                    {"Passed\n%"},
                    {"False positives\n%"},
                    {"False negatives"},
                    {"Area"},
                    {"Area with\nwhat follows"}},
        .rows = {}};
    const PrecisionRow* after = row_of(report, scene.scene, "woop_top_left", model::methods::binary32);
    const double full = after == nullptr ? 0 : after->area.value_or(0);
    if (full > 0) {
        table.note += fmt::format(
            "\nWith what follows: the area of woop_top_left in binary32, {:.1f}, counts for "
            "the share of tests that it is given.",
            full);
    }
    for (const FilterRow& row : report.filters) {
        if (row.scene != scene.scene) continue;
        table.rows.push_back(
            {to_string(row.format), grouped(row.tests), percent(row.hits, row.tests),
             percent(row.passed, row.tests), fixed(row.false_positive_percent(), 2),
             grouped(row.false_negatives), area(row.area),
             full > 0 ? area(row.area + full * double(row.passed) / double(row.tests)) : "-"});
    }
    return table;
}

std::string price(const PrecisionReport& report, const PrecisionRow& row) {
    const PrecisionRow* wide = row_of(report, row.scene, row.method, model::methods::binary32);
    if (wide == nullptr || !wide->area || !row.area) return "";
    return fmt::format("Its area is {:.1f} binary32 multipliers, {:.0f} % of the {:.1f} in binary32.",
                       *row.area, 100 * *row.area / *wide->area, *wide->area);
}

}  // namespace

std::string precision_answer(const PrecisionReport& report, const PrecisionAnswer& scene) {
    const std::string rays =
        fmt::format("{} rays ({})", grouped(scene.rays), fmt::join(scene.workloads, ", "));
    const std::string wanted =
        fmt::format("at most {:g} of a million rays wrong with 95 % confidence", report.wrong_per_million);
    if (!scene.row) {
        return fmt::format("{}: none of the methods and formats is exact enough on {}: {}.", scene.scene,
                           rays, wanted);
    }
    const PrecisionRow& row = report.rows[*scene.row];
    std::string text = fmt::format(
        "{}: {} in {} ({} bits) is the cheapest that is exact enough: {} of {} wrong; asked for were {}.",
        scene.scene, row.method, to_string(row.format), row.format.width_bits(), grouped(row.wrong()), rays,
        wanted);
    text += "\n" + price(report, row);
    const PrecisionRow* less = one_bit_less(report, row);
    if (less != nullptr) {
        text += fmt::format(" With one bit less, {} rays are wrong.", grouped(less->wrong()));
    }
    if (row.is_watertight()) return text + " It neither leaks nor hits twice.";
    text += fmt::format(" Of {} rays aimed at edges and vertices, {} leak and {} hit twice.",
                        grouped(row.aimed_rays), grouped(row.leaks), grouped(row.doubles));
    if (!scene.watertight_row) return text + "\nNo other that is exact enough does better.";
    const PrecisionRow& tight = report.rows[*scene.watertight_row];
    return text + fmt::format(
                      "\nWithout leaks and double hits, the cheapest is {} in {} ({} bits), {} of {} "
                      "wrong. {}",
                      tight.method, to_string(tight.format), tight.format.width_bits(),
                      grouped(tight.wrong()), rays, price(report, tight));
}

std::vector<StudyTable> precision_tables(const PrecisionReport& report, const PrecisionAnswer& scene) {
    std::vector<StudyTable> tables{method_table(report, scene)};
    if (scene.row) tables.push_back(ladder_table(report, report.rows[*scene.row]));
    tables.push_back(filter_table(report, scene));
    return tables;
}

}  // namespace rtu::study
