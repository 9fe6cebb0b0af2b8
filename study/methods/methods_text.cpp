#include "study/methods/methods_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/methods/operation_counts.hpp"
#include "study/text_table.hpp"

namespace rtu::study {

namespace {

using model::methods::Form;
using Align = TextTable::Align;

constexpr double million = 1e6;

std::string millions(std::optional<double> per_second) {
    return per_second ? fixed(*per_second / million, 1) : "-";
}

std::string ratio(std::optional<double> value) { return value ? fixed(*value, 2) : "-"; }

std::string cycles_text(const MethodsReport& report, std::optional<double> per_second) {
    return per_second ? fixed(report.clock_hz / *per_second, 1) : "-";
}

const MethodsRow* row_of(const MethodsReport& report, std::string_view method, Form form,
                         std::uint32_t width) {
    const auto found = std::ranges::find_if(report.rows, [&](const MethodsRow& row) {
        return row.workload == "random" && row.kernel.method.name == method && row.kernel.form == form &&
               row.kernel.width == width;
    });
    return found == report.rows.end() ? nullptr : &*found;
}

std::string facts(const MethodsReport& report) {
    return fmt::format(
        "rtusim {}, instruction set {}, core at {} GHz, seed {}, least of {} repeats, one thread\n"
        "Workload random: {} rays against each of {} triangles in the unit cube.\n",
        report.version, report.instruction_set, fixed(report.clock_hz / 1e9, 2), report.seed, report.repeats,
        grouped(report.ray_count), grouped(report.triangle_count));
}

// A published figure beside ours: both speeds, and both as shares of Wald's.
void add_published(TextTable& table, const MethodsReport& report, const PublishedSpeed& speed, Form form,
                   std::uint32_t width, std::optional<double> published,
                   std::optional<double> published_worst) {
    const MethodsRow* row = row_of(report, speed.method, form, width);
    const MethodsRow* wald = row_of(report, "wald", form, width);
    if (row == nullptr || !published) return;
    const PublishedSpeed& their_wald = published_speeds().front();
    const bool is_packet = form == Form::Rays;
    const double wald_single = is_packet ? *their_wald.packets : their_wald.single;
    const double wald_worst = is_packet ? *their_wald.packets_worst : their_wald.single_worst;
    const auto ours = [&](double mine, double of_wald) {
        return wald == nullptr ? std::nullopt : std::optional(mine / of_wald);
    };
    table.add_row({std::string(row->kernel.method.title), is_packet ? "packets of 4" : "single rays",
                   millions(row->tests_per_second), fixed(*published, 0),
                   ratio(ours(row->tests_per_second, wald ? wald->tests_per_second : 1)),
                   ratio(*published / wald_single), millions(row->worst_tests_per_second),
                   fixed(*published_worst, 0),
                   ratio(ours(*row->worst_tests_per_second, wald ? *wald->worst_tests_per_second : 1)),
                   ratio(*published_worst / wald_worst)});
}

std::string published_table(const MethodsReport& report) {
    TextTable table({{"Method", Align::Left},
                     {"Rays", Align::Left},
                     {"Tests\nM/s"},
                     {"\npaper"},
                     {"Of Wald's\n"},
                     {"\npaper"},
                     {"Worst case\nM/s"},
                     {"\npaper"},
                     {"Of Wald's\n"},
                     {"\npaper"}});
    for (const PublishedSpeed& speed : published_speeds())
        add_published(table, report, speed, Form::Single, 1, speed.single, speed.single_worst);
    table.add_rule();
    for (const PublishedSpeed& speed : published_speeds())
        add_published(table, report, speed, Form::Rays, 4, speed.packets, speed.packets_worst);
    return "\nBeside Table I of Havel and Herout 2011 (Core 2 Duo E8200, Microsoft compiler)\n" +
           table.text();
}

std::string precompute_table(const MethodsReport& report) {
    TextTable table({{"Method", Align::Left},
                     {"Stored\nbytes"},
                     {"Precomputation\nM triangles/s"},
                     {"\npaper"},
                     {"Of Wald's\n"},
                     {"\npaper"}});
    const MethodsRow* wald = row_of(report, "wald", Form::Single, 1);
    for (const MethodsRow& row : report.rows) {
        if (row.workload != "random" || row.kernel.form != Form::Single) continue;
        const auto speeds = published_speeds();
        const auto theirs = std::ranges::find(speeds, row.kernel.method.name, &PublishedSpeed::method);
        const bool is_theirs = theirs != speeds.end();
        table.add_row(
            {std::string(row.kernel.method.title), grouped(row.kernel.method.stored_bytes),
             millions(row.precompute_triangles_per_second), is_theirs ? fixed(theirs->precompute, 1) : "-",
             wald ? ratio(*row.precompute_triangles_per_second / *wald->precompute_triangles_per_second)
                  : "-",
             is_theirs ? ratio(theirs->precompute / speeds.front().precompute) : "-"});
    }
    return "\nPrecomputation, beside Table II of the same\n" + table.text();
}

std::string form_text(const MethodsRow& row) {
    const std::uint32_t w = row.kernel.width;
    switch (row.kernel.form) {
        case Form::Single:
            return "1 ray x 1 triangle";
        case Form::Rays:
            return fmt::format("{} rays x 1 triangle", w);
        case Form::Triangles:
            return fmt::format("1 ray x {} triangles", w);
        case Form::Pairs:
            break;
    }
    return w == 1 ? "1 ray x 1 pair" : fmt::format("1 ray x {} pairs", w);
}

std::string all_forms_table(const MethodsReport& report) {
    TextTable table({{"Method", Align::Left},
                     {"At once", Align::Left},
                     {"Tests\nM/s"},
                     {"Cycles\na test"},
                     {"Of Wald's\n"},
                     {"First pass\nM/s"},
                     {"Worst case\nM/s"},
                     {"Cycles\na test"}});
    std::string_view method;
    for (const MethodsRow& row : report.rows) {
        if (row.workload != "random") continue;
        if (!method.empty() && method != row.kernel.method.name) table.add_rule();
        method = row.kernel.method.name;
        table.add_row({std::string(row.kernel.method.title), form_text(row), millions(row.tests_per_second),
                       cycles_text(report, row.tests_per_second), ratio(ratio_to_wald(report, row)),
                       millions(row.first_pass_tests_per_second), millions(row.worst_tests_per_second),
                       cycles_text(report, row.worst_tests_per_second)});
    }
    return "\nAll forms. Worst case: a hit does not shorten the ray. First pass: over rays whose outcomes "
           "the\n"
           "branch predictor does not yet know; the other figures are of repeated passes, as in papers.\n" +
           table.text();
}

std::string scaling_table(const MethodsReport& report) {
    if (report.scaling.empty()) return "";
    TextTable table({{"Method", Align::Left}, {"Tests"}, {"Time\nms"}, {"Tests\nM/s"}});
    for (const MethodsScalingRow& row : report.scaling)
        table.add_row({row.method, grouped(row.tests), fixed(row.seconds * 1e3, 2),
                       millions(double(row.tests) / row.seconds)});
    return "\nTime against the number of tests, scalar (Robert and Schweri 2004: linear, about 8 M/s on a "
           "2.8 GHz\n"
           "Pentium 4)\n" +
           table.text();
}

std::string leaf_table(const MethodsReport& report) {
    TextTable table({{"Scene/rays", Align::Left},
                     {"Method", Align::Left},
                     {"At once", Align::Left},
                     {"Tests"},
                     {"Tests\nM/s"},
                     {"Cycles\na test"},
                     {"Of Wald's\n"}});
    std::string_view workload;
    for (const MethodsRow& row : report.rows) {
        if (row.workload == "random") continue;
        if (!workload.empty() && workload != row.workload) table.add_rule();
        workload = row.workload;
        table.add_row({row.workload, std::string(row.kernel.method.title), form_text(row), grouped(row.tests),
                       millions(row.tests_per_second), cycles_text(report, row.tests_per_second),
                       ratio(ratio_to_wald(report, row))});
    }
    if (workload.empty()) return "";
    return "\nEach ray on the triangles of the leaves that it visits, its set-up included\n" + table.text();
}

std::string counts_text(const model::methods::OperationCounts& counts) {
    return fmt::format("{} {} {} {}", counts.mul, counts.add, counts.div, counts.fusable);
}

bool is_measured(const MethodsReport& report, std::string_view method) {
    return std::ranges::any_of(report.rows,
                               [&](const MethodsRow& row) { return row.kernel.method.name == method; });
}

std::string operations_table(const MethodsReport& report) {
    TextTable table({{"Method", Align::Left},
                     {"Precomputation\nm a d f"},
                     {"Soonest miss\nm a d f"},
                     {"Full test\nm a d f"},
                     {"Hit, with t, u, v\nm a d f"},
                     {"Two, full\nm a d f"},
                     {"Pair, one full\nm a d f"},
                     {"Pair, both full\nm a d f"}});
    for (const model::methods::MethodCounts& counts : model::methods::operation_counts()) {
        if (!is_measured(report, counts.name)) continue;
        const auto& single = counts.single;
        std::vector<std::string> cells{std::string(counts.name), counts_text(counts.precomputation),
                                       counts_text(single.rejected), counts_text(single.full),
                                       counts_text(single.hit)};
        model::methods::OperationCounts two = single.full;
        two.mul *= 2, two.add *= 2, two.div *= 2, two.fusable *= 2;
        cells.push_back(counts.pair ? counts_text(two) : "-");
        cells.push_back(counts.pair ? counts_text(counts.pair->one_full) : "-");
        cells.push_back(counts.pair ? counts_text(counts.pair->both_full) : "-");
        table.add_row(cells);
    }
    return "\nOperations: multiplications, additions, divisions, and additions that can be fused with a "
           "multiplication\n" +
           table.text();
}

std::string early_exits_table(const MethodsReport& report) {
    if (report.early_exits.empty()) return "";
    TextTable table({{"Scene/rays", Align::Left},
                     {"Tests"},
                     {"Distance rejects\n%"},
                     {"Aperture rejects\n%"},
                     {"Both reject\n%"},
                     {"Hits\n%"},
                     {"Aperture first\nof distance first"}});
    for (const MethodsEarlyExits& row : report.early_exits) {
        const auto& e = row.exits;
        const auto found = std::ranges::find_if(report.rows, [&](const MethodsRow& one) {
            return one.workload == row.workload && one.kernel.method.name == "shevtsov" &&
                   one.kernel.width == 1;
        });
        const MethodsRow* other =
            found == report.rows.end() ? nullptr : same_row(report, *found, "shevtsov_distance_first");
        table.add_row({row.workload, grouped(e.tests), percent(e.by_both + e.by_distance_only, e.tests),
                       percent(e.by_both + e.by_aperture_only, e.tests), percent(e.by_both, e.tests),
                       percent(e.hits, e.tests),
                       other == nullptr ? "-" : ratio(found->tests_per_second / other->tests_per_second)});
    }
    return "\nWhat the two halves of Shevtsov's test reject, and the speed of the order that the paper "
           "argues for\n" +
           table.text();
}

}  // namespace

const MethodsRow* same_row(const MethodsReport& report, const MethodsRow& row, std::string_view method) {
    const auto found = std::ranges::find_if(report.rows, [&](const MethodsRow& other) {
        return other.workload == row.workload && other.kernel.method.name == method &&
               other.kernel.form == row.kernel.form && other.kernel.width == row.kernel.width;
    });
    return found == report.rows.end() ? nullptr : &*found;
}

std::optional<double> ratio_to_wald(const MethodsReport& report, const MethodsRow& row) {
    const MethodsRow* wald = same_row(report, row, "wald");
    return wald == nullptr ? std::nullopt : std::optional(row.tests_per_second / wald->tests_per_second);
}

std::string methods_text(const MethodsReport& report) {
    return facts(report) + published_table(report) + precompute_table(report) + all_forms_table(report) +
           operations_table(report) + scaling_table(report) + leaf_table(report) + early_exits_table(report);
}

}  // namespace rtu::study
