#include "study/chart/chart_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "study/chart/html_page.hpp"
#include "study/methods/method_charts_rows.hpp"
#include "study/methods/methods_study.hpp"
#include "study/precision/precision_ladder.hpp"
#include "study/precision/precision_tables.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

using model::methods::Form;

constexpr std::uint32_t parity_size = 200;

constexpr std::array charts = std::to_array<ChartInfo>({
    {"speed", "tests a second against the error of t, leaks as colour",
     "Better is up and to the left; dark blue leaks nothing. Speed is of one ray against eight triangles at "
     "once "
     "on random rays that get shorter; errors are of random rays inside a ball of radius 2 at the origin."},
    {"offset", "leaks and double hits of a ball that is moved away from the origin",
     "Each ray starts inside a closed ball and must hit once. Methods that see a triangle from the world's "
     "origin "
     "fail the more the farther away it is; beyond 1e6 the ball's vertices lie on a coarse grid, and aimed "
     "rays "
     "run exactly through edges."},
    {"cases", "every method in every case of rtusim stability",
     "Green cells are free of failures. What counts as one depends on the case: see rtusim stability."},
    {"errors", "how large errors of t are, near the origin and far from it",
     "A line far to the left is an accurate method. Far from the origin only methods that first move the "
     "triangle "
     "to the ray stay where they were."},
    {"operations", "what a pair of triangles with a common edge saves",
     "Counted while the methods' own code runs, without the comparison of t with the ray's interval and the "
     "division for t, u and v. Both triangles of a pair are hit only if it is folded; with one depth unit, "
     "which "
     "is free for the other half, a pair takes what it does for one hit."},
    {"widths", "how packets speed up with SIMD width, beside the published table",
     "Published: Havel and Herout, Table I, Core 2 Duo E8200, single rays and packets of four. Theirs are "
     "dashed "
     "lines."},
    {"parity", "which rays leave a closed mesh unseen, or hit it twice",
     "Looking around from inside a spiky closed mesh, 90 degrees wide. Each pixel has a ray of its own, and "
     "rays "
     "at 101 points of every edge; the worst of a pixel counts."},
    {"precision", "what narrower number formats do to a scene's rays",
     "Each line is a method, each point a mantissa from 7 (left) to 23 bits (right) with an exponent of 8 "
     "bits. "
     "The area is a proxy: multiplier (p/24)^2, adder 0.3 p/24, divider 8 (p/24)^2, assumed. At the bottom "
     "no "
     "ray of the sample is wrong."},
});

bool is_wanted(const ChartOptions& options, std::string_view name) {
    return options.names.empty() || std::ranges::find(options.names, name) != options.names.end();
}

void tell(const ChartOptions& options, std::string_view what, std::string_view phase) {
    if (options.progress) options.progress(fmt::format("{}: {}", what, phase));
}

MethodsReport measure_speeds(const ChartOptions& options, std::vector<Form> forms,
                             std::vector<std::string> methods) {
    MethodsOptions speeds;
    speeds.forms = std::move(forms);
    speeds.methods = std::move(methods);
    speeds.repeats = options.repeats;
    speeds.seed = options.seed;
    speeds.progress = [&](std::string_view phase) { tell(options, "speed", phase); };
    return run_methods_study(speeds);
}

StabilityReport measure_stability(const ChartOptions& options) {
    StabilityOptions stability;
    stability.rays = options.rays;
    stability.seed = options.seed;
    if (is_wanted(options, "cases")) {
        stability.cases = stability_case_names();
        // A tree of more than a million triangles would take longer than all others together.
        std::erase(stability.cases, "large_mesh");
    } else {
        stability.cases = {"far_offset"};
        if (is_wanted(options, "speed")) {
            stability.cases.emplace_back("shared_edge");
            stability.cases.emplace_back("shared_vertex");
        }
    }
    stability.progress = [&](std::string_view what, std::string_view phase) { tell(options, what, phase); };
    return run_stability(stability);
}

PrecisionReport measure_precision(const ChartOptions& options) {
    PrecisionOptions precision;
    precision.scenes = {options.scene};
    precision.camera_file = options.camera_file;
    precision.ray_count = options.rays;
    precision.seed = options.seed;
    precision.progress = [&](std::string_view phase) { tell(options, "precision", phase); };
    return run_precision_study(precision);
}

AnyChart make_chart(std::string_view name, const ChartData& data) {
    if (name == "speed") return speed_chart(*data.leaf_speeds, *data.stability);
    if (name == "offset") return offset_chart(data.offsets);
    if (name == "cases") return failure_chart(*data.stability);
    if (name == "errors") return error_chart(*data.stability);
    if (name == "operations") return operation_chart(model::methods::operation_counts());
    if (name == "widths") return width_chart(*data.packet_speeds);
    if (name == "parity") return parity_chart(data.parity, data.parity_size, data.parity_size);
    RTU_CHECK(name == "precision", "no chart {}", name);
    return precision_chart(*data.precision);
}

}  // namespace

std::span<const ChartInfo> known_charts() { return charts; }

void check_chart_names(const std::vector<std::string>& names) {
    std::vector<std::string_view> known;
    for (const ChartInfo& chart : charts) known.push_back(chart.name);
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (std::ranges::find(known, *name) == known.end()) {
            throw Error("--only: expected one of {}, got '{}'", fmt::join(known, ", "),
                        model::one_line(*name));
        }
        if (std::find(names.begin(), name, *name) != name) throw Error("--only: '{}' is given twice", *name);
    }
}

ChartData measure_charts(const ChartOptions& options) {
    ChartData data;
    const auto wants = [&](std::string_view name) { return is_wanted(options, name); };
    if (wants("speed")) data.leaf_speeds = measure_speeds(options, {Form::Triangles}, {});
    if (wants("widths")) {
        data.packet_speeds = measure_speeds(options, {Form::Single, Form::Rays},
                                            {width_chart_methods.begin(), width_chart_methods.end()});
    }
    if (wants("speed") || wants("cases") || wants("errors")) data.stability = measure_stability(options);
    if (wants("precision")) data.precision = measure_precision(options);
    if (wants("offset")) {
        tell(options, "offset", "rays at edges and vertices");
        data.offsets = measure_offsets(options.rays, options.seed);
    }
    if (wants("parity")) {
        tell(options, "parity", "rays from inside");
        const std::array<std::string, 4> methods{"moller_trumbore", "havel_herout", "embree_plucker",
                                                 "woop_top_left"};
        data.parity_size = parity_size;
        data.parity = parity_maps(methods, parity_size, parity_size);
    }
    return data;
}

std::vector<NamedChart> make_charts(const ChartOptions& options, const ChartData& data) {
    std::vector<NamedChart> made;
    for (const ChartInfo& info : charts) {
        if (is_wanted(options, info.name)) made.push_back({&info, make_chart(info.name, data)});
    }
    return made;
}

std::string charts_html(const ChartOptions& options, std::span<const NamedChart> made) {
    std::string body = fmt::format("<p class=\"note\">rtusim {}, seed {}, {} rays a setting</p>\n", version(),
                                   options.seed, options.rays);
    for (const NamedChart& one : made) {
        body += fmt::format("<h2>{}</h2>\n<p>{}</p>\n", html_escaped(title_of(one.chart)),
                            html_escaped(one.info->reading));
        body += html_figure(draw(one.chart, ChartFormat::Svg), name_of(one.chart));
    }
    return html_page("Ray-triangle methods: speed, accuracy and where they fail", body);
}

}  // namespace rtu::study
