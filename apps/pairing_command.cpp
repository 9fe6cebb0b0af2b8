#include "apps/pairing_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/pairing_command_plan.hpp"
#include "apps/progress.hpp"
#include "apps/standard_output.hpp"
#include "study/output_file.hpp"
#include "study/pairing/pairing_html.hpp"
#include "study/pairing/pairing_json.hpp"
#include "study/pairing/pairing_study.hpp"
#include "study/pairing/pairing_text.hpp"

namespace rtu::apps {
namespace {

constexpr const char* pairing_description =
    "tell what a triangle pairing does to this hardware on these scenes, against a baseline pairing:\n"
    "box tests, pair tests, MRPS, memory, and which part of the machine is the limit";

std::string pairing_footer() {
    std::string text = "Studies (--study NAME,... or all), each a table and charts:\n";
    for (const study::PairingStudyInfo& study : study::pairing_studies()) {
        text += fmt::format("  {:<16}{}\n", study.name, study.meaning);
    }
    return text +
           "\nExamples:\n"
           "  rtusim pairing bunny.glb dragon.glb                    the table of the paper on pairing\n"
           "  rtusim pairing *.glb --preset pairing_paper            on the machine for the paper's table\n"
           "  rtusim pairing a.glb --methods edge_bbsa,window:16     several methods, an average for each\n"
           "  rtusim pairing a.glb --baseline none                   what pairing gains over no pairs\n"
           "  rtusim pairing a.glb --rotate 0,45,0                   the scene turned, the picture the same\n"
           "  rtusim pairing a.glb --study window,rotation --charts out     SVG and PNG files\n"
           "  rtusim pairing a.glb --study all --html pairing.html   one page with all tables and charts\n"
           "  rtusim pairing a.glb --json - | jq '.rows[0].delta_mrps_percent'\n";
}

void add_comparison_options(CLI::App& pairing, PairingArguments& arguments) {
    add_scenes_option(pairing, arguments.scenes);
    pairing.add_option("--baseline", arguments.baseline, "the pairing to compare with: a METHOD as in `run`")
        ->type_name("METHOD")
        ->capture_default_str();
    pairing.add_option("--methods", arguments.methods, "the pairings to compare")
        ->type_name("LIST")
        ->capture_default_str();
    pairing.add_option("--study", arguments.studies, "studies besides the comparison, see below; or all")
        ->type_name("LIST")
        ->check(is_not_empty());
    pairing
        .add_option("--edge-identity", arguments.edge_identity,
                    "corners are one vertex by position (bit-equal) or by index (the file's)")
        ->type_name("KIND")
        ->capture_default_str();
}

void add_ray_options(CLI::App& pairing, PairingArguments& arguments) {
    add_workloads_option(pairing, arguments.workloads);
    add_resolution_option(pairing, arguments.resolution);
    add_camera_option(pairing, arguments.camera);
    pairing
        .add_option("--rotate", arguments.rotation,
                    "degrees about x, then y, then z; mesh and camera turn together")
        ->type_name("AX,AY,AZ")
        ->capture_default_str();
    add_seed_option(pairing, arguments.seed);
}

void add_output_options(CLI::App& pairing, PairingArguments& arguments) {
    pairing
        .add_option("--json", arguments.json,
                    "write the report as JSON; - is standard output, and no text then")
        ->type_name("FILE|-")
        ->check(is_not_empty());
    pairing.add_option("--csv", arguments.csv, "write the rows of the comparison and of all studies as CSV")
        ->type_name("FILE")
        ->check(is_not_empty());
    pairing.add_option("--html", arguments.html, "write one page with all tables and charts (needs gnuplot)")
        ->type_name("FILE")
        ->check(is_not_empty());
    pairing
        .add_option("--charts", arguments.chart_folder,
                    "write every chart as SVG and PNG there; made if missing (needs gnuplot)")
        ->type_name("DIR")
        ->check(is_not_empty());
    add_threads_option(pairing, arguments.threads);
}

study::PairingReport compare(PairingPlan& plan) {
    Progress progress;
    std::string scene;
    plan.options.progress = [&](std::string_view phase) { progress.show(scene, phase); };
    return study::run_pairing_studies(plan.options, plan.scenes,
                                      [&scene](const std::string& name) { scene = name; });
}

void write_outputs(const PairingPlan& plan, const study::PairingReport& report) {
    std::vector<study::OutputFile> files;
    if (plan.json) files.push_back({*plan.json, study::pairing_json(report)});
    if (plan.csv) files.push_back({*plan.csv, study::pairing_csv(report)});
    if (plan.html) files.push_back({*plan.html, study::pairing_html(report)});
    if (plan.chart_folder) {
        for (const study::Chart& chart : study::pairing_charts(report)) {
            const auto path = *plan.chart_folder / chart.name;
            files.push_back({path.string() + ".svg", draw(chart, study::ChartFormat::Svg)});
            files.push_back({path.string() + ".png", draw(chart, study::ChartFormat::Png)});
        }
    }
    study::write_files(files);
}

int run_pairing(const PairingArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    PairingPlan plan = make_pairing_plan(arguments);
    const ThreadLimit limit(plan.threads);
    const study::PairingReport report = compare(plan);
    write_outputs(plan, report);
    print_all(plan.is_json_to_stdout ? study::pairing_json(report) : study::pairing_text(report));
    return exit_done;
}

}  // namespace

void add_pairing_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<PairingArguments>();
    CLI::App* pairing = app.add_subcommand("pairing", pairing_description);
    pairing->footer(pairing_footer());
    pairing->get_formatter()->column_width(34);
    add_comparison_options(*pairing, *arguments);
    add_ray_options(*pairing, *arguments);
    add_machine_options(*pairing, arguments->machine);
    add_link_option(*pairing, arguments->machine);
    add_output_options(*pairing, *arguments);
    pairing->callback([arguments, &command] { command = [arguments] { return run_pairing(*arguments); }; });
}

}  // namespace rtu::apps
