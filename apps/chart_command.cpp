#include "apps/chart_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/standard_output.hpp"
#include "model/error.hpp"
#include "study/chart/chart_study.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

constexpr const char* chart_description =
    "make the pictures of the studies of ray-triangle methods, measured on this host (about a minute);\n"
    "needs gnuplot";

struct ChartArguments {
    std::string folder = "charts";
    std::string html;
    std::string names;
    std::string scene;
    std::string camera;
    std::uint32_t rays = study::ChartOptions{}.rays;
    std::uint32_t repeats = study::ChartOptions{}.repeats;
    std::string seed = "1";
    unsigned threads = 0;
};

std::string chart_footer() {
    std::string text = "Pictures:\n";
    for (const study::ChartInfo& chart : study::known_charts()) {
        text += fmt::format("  {:<12}{}\n", chart.name, chart.meaning);
    }
    return text +
           "\nExamples:\n"
           "  rtusim chart                                  all, as SVG and PNG in the folder charts\n"
           "  rtusim chart --out pictures --html page.html  and one page with all of them\n"
           "  rtusim chart --only cases,offset --rays 10000\n"
           "  rtusim chart --only precision --scene bunny.glb\n";
}

void add_options(CLI::App& chart, ChartArguments& arguments) {
    chart.add_option("--out", arguments.folder, "where the SVG and PNG files go; made if missing")
        ->type_name("DIR")
        ->check(is_not_empty())
        ->capture_default_str();
    chart.add_option("--html", arguments.html, "write one page with all pictures and how to read them")
        ->type_name("FILE")
        ->check(is_not_empty());
    chart.add_option("--only", arguments.names, "only these pictures, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    chart.add_option("--rays", arguments.rays, "a setting, of every study")
        ->type_name("N")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    chart.add_option("--repeats", arguments.repeats, "of the timings; the least time counts")
        ->type_name("N")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    chart
        .add_option("--scene", arguments.scene,
                    "glTF 2.0 file for `precision`; without it the built-in scene")
        ->type_name("FILE")
        ->check(is_not_empty());
    chart.add_option("--camera", arguments.camera, "TOML with its camera, as in `rtusim run`")
        ->type_name("FILE")
        ->check(is_not_empty());
    add_seed_option(chart, arguments.seed);
    chart.add_option("--threads", arguments.threads, "host threads at most, 0: all; timings use one")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

study::ChartOptions options_of(const ChartArguments& arguments) {
    study::ChartOptions options;
    options.names = parse_list("--only", arguments.names);
    study::check_chart_names(options.names);
    options.rays = arguments.rays;
    options.repeats = arguments.repeats;
    options.seed = parse_seed(arguments.seed);
    if (!arguments.scene.empty()) options.scene = parse_scenes({arguments.scene}).front();
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, {options.scene});
    return options;
}

void check_outputs(const ChartArguments& arguments) {
    std::vector<std::filesystem::path> inputs;
    for (const std::string& name : {arguments.scene, arguments.camera}) {
        if (!name.empty()) inputs.emplace_back(name);
    }
    if (!arguments.html.empty()) check_output(arguments.html, inputs);
    study::check_writable_folder(arguments.folder);
    study::check_gnuplot();
}

std::vector<study::NamedChart> measure(study::ChartOptions& options) {
    Progress progress;
    options.progress = [&](std::string_view phase) { progress.show("chart", phase); };
    return study::make_charts(options, study::measure_charts(options));
}

int run_chart(const ChartArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::ChartOptions options = options_of(arguments);
    check_outputs(arguments);
    const ThreadLimit limit(arguments.threads);
    const std::vector<study::NamedChart> charts = measure(options);
    std::vector<study::OutputFile> files;
    std::string said;
    for (const study::NamedChart& one : charts) {
        const auto path = std::filesystem::path(arguments.folder) / study::name_of(one.chart);
        files.push_back({path.string() + ".svg", study::draw(one.chart, study::ChartFormat::Svg)});
        files.push_back({path.string() + ".png", study::draw(one.chart, study::ChartFormat::Png)});
        said += fmt::format("{}.svg, .png: {}\n", path.string(), study::title_of(one.chart));
    }
    if (!arguments.html.empty()) {
        files.push_back({arguments.html, study::charts_html(options, charts)});
        said += arguments.html + "\n";
    }
    study::write_files(files);
    print_all(said);
    return exit_done;
}

}  // namespace

void add_chart_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<ChartArguments>();
    CLI::App* chart = app.add_subcommand("chart", chart_description);
    chart->footer(chart_footer());
    chart->get_formatter()->column_width(34);
    add_options(*chart, *arguments);
    chart->callback([arguments, &command] { command = [arguments] { return run_chart(*arguments); }; });
}

}  // namespace rtu::apps
