#include "apps/fidelity_command.hpp"

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
#include "apps/report_output.hpp"
#include "model/error.hpp"
#include "sim/effective_config.hpp"
#include "sim/presets.hpp"
#include "study/fidelity/fidelity_output.hpp"
#include "study/output_file.hpp"
#include "study/validate/rtl_reference.hpp"

namespace rtu::apps {
namespace {

constexpr const char* fidelity_description =
    "compare the levels of fidelity with every ray through the cycle model: error of MRPS, whether it is\n"
    "inside the stated interval, host speed, and whether the level ranks 20 machines in the same order";

constexpr const char* fidelity_footer =
    "Examples:\n"
    "  rtusim fidelity                                        the built-in scene, four machines\n"
    "  rtusim fidelity *.glb --camera scenes.toml --json all.json --chart fidelity\n"
    "                                                         several scenes, and fidelity.svg, "
    "fidelity.png\n"
    "  rtusim fidelity bunny.glb --preset default --workload primary --resolution 1024x1024\n"
    "  rtusim fidelity --level sampled --tolerance 1 --json - | jq '.rows[].error_percent'\n";

struct FidelityArguments {
    std::vector<std::string> scenes;
    std::string presets = "default,cxt,rdna4,xe_hpg";
    std::string levels = "counts,analytic,sampled,auto";
    std::string workloads = "primary,shadow,diffuse";
    std::string resolution = "512x512";
    std::string tolerance = "2";
    std::string camera;
    std::string seed = "1";
    bool has_no_ranking = false;
    std::string chart;
    ReportOutput output;
};

void add_study_options(CLI::App& fidelity, FidelityArguments& arguments) {
    add_scenes_option(fidelity, arguments.scenes);
    const auto add = [&](const char* name, std::string& value, const char* help, const char* type) {
        fidelity.add_option(name, value, help)->type_name(type)->capture_default_str();
    };
    add("--preset", arguments.presets, "machines, of those of `rtusim config --preset`", "LIST");
    add("--level", arguments.levels,
        "of counts, analytic, sampled, auto, and rtl: 48 x 48 pixels on the machine of the RTL", "LIST");
    add("--workload", arguments.workloads, "rays, of primary, shadow, ao, diffuse, random", "LIST");
    add("--resolution", arguments.resolution, "picture size in pixels", "WxH");
    add("--tolerance", arguments.tolerance, "of sampled and auto, in % of MRPS, 0.6 to 50", "PCT");
    add("--seed", arguments.seed, "of the random numbers", "N");
    add_camera_option(fidelity, arguments.camera);
    fidelity.add_flag("--no-ranking", arguments.has_no_ranking,
                      "leave out the 20 machines: the first scene and machine, the last workload");
}

void add_output_options(CLI::App& fidelity, FidelityArguments& arguments) {
    add_report_options(fidelity, arguments.output);
    fidelity
        .add_option("--chart", arguments.chart,
                    "write speed against error as NAME.svg and NAME.png; needs gnuplot")
        ->type_name("NAME")
        ->check(is_not_empty());
}

std::vector<study::NamedMachine> machines_of(const std::string& presets) {
    std::vector<study::NamedMachine> machines;
    for (const std::string& name : parse_list("--preset", presets)) {
        machines.push_back({name, sim::load_config(name, std::nullopt, {})});
    }
    if (machines.empty()) throw Error("--preset: expected at least one machine, got ''");
    return machines;
}

std::vector<study::FidelityLevel> levels_of(const std::string& names) {
    std::vector<study::FidelityLevel> levels;
    for (const std::string& name : parse_list("--level", names)) {
        levels.push_back(study::parse_fidelity_level(name));
        if (levels.back() == study::FidelityLevel::Cycle) {
            throw Error("--level: cycle is what the others are compared with, and always there");
        }
        // Throws where the RTL is not there: now rather than after the first scene.
        if (levels.back() == study::FidelityLevel::Rtl) static_cast<void>(study::rtl_reference());
    }
    return levels;
}

study::FidelityOptions options_of(const FidelityArguments& arguments) {
    study::FidelityOptions options;
    options.scenes = parse_scenes(arguments.scenes);
    options.machines = machines_of(arguments.presets);
    options.levels = levels_of(arguments.levels);
    options.workloads = parse_workloads(arguments.workloads);
    options.resolution = parse_resolution(arguments.resolution);
    options.tolerance = parse_tolerance(arguments.tolerance);
    options.seed = parse_seed(arguments.seed);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, options.scenes);
    options.ranks_configurations = !arguments.has_no_ranking;
    return options;
}

void check_outputs(const FidelityArguments& arguments) {
    std::vector<std::filesystem::path> inputs(arguments.scenes.begin(), arguments.scenes.end());
    if (!arguments.camera.empty()) inputs.emplace_back(arguments.camera);
    check_report_output(arguments.output, inputs);
    if (arguments.chart.empty()) return;
    for (const char* extension : {".svg", ".png"}) check_output(arguments.chart + extension, inputs);
    study::check_gnuplot();
}

int run_fidelity(const FidelityArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::FidelityOptions options = options_of(arguments);
    check_outputs(arguments);
    // One thread: CPU seconds of several on the same caches would compare badly.
    const ThreadLimit limit(1);
    study::FidelityReport report;
    {
        Progress progress;
        options.progress = [&](std::string_view phase) { progress.show("fidelity", phase); };
        report = study::run_fidelity_study(options);
    }
    if (!arguments.chart.empty()) {
        const study::Chart chart = study::fidelity_chart(report);
        const std::vector<study::OutputFile> files{
            {arguments.chart + ".svg", study::draw(chart, study::ChartFormat::Svg)},
            {arguments.chart + ".png", study::draw(chart, study::ChartFormat::Png)}};
        study::write_files(files);
    }
    write_report(arguments.output, study::fidelity_text(report), study::fidelity_json(report),
                 study::fidelity_csv(report));
    return exit_done;
}

}  // namespace

void add_fidelity_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<FidelityArguments>();
    CLI::App* fidelity = app.add_subcommand("fidelity", fidelity_description);
    fidelity->footer(fidelity_footer);
    fidelity->get_formatter()->column_width(34);
    add_study_options(*fidelity, *arguments);
    add_output_options(*fidelity, *arguments);
    fidelity->callback([arguments, &command] { command = [arguments] { return run_fidelity(*arguments); }; });
}

}  // namespace rtu::apps
