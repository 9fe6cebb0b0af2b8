#include "apps/area_command.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/chart_files.hpp"
#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/report_output.hpp"
#include "model/error.hpp"
#include "sim/presets.hpp"
#include "study/area/area_charts.hpp"
#include "study/area/area_output.hpp"
#include "study/area/area_study.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

constexpr const char* area_description =
    "tell what a machine is made of: gates, register bits, multipliers, adders and SRAM bits of every unit, "
    "from\n"
    "the synthesised RTL reference; with scenes, MRPS per million gates, and what sharing a pair's common "
    "edge\n"
    "saves in gates against what it costs in cycles";

constexpr const char* area_footer =
    "Examples:\n"
    "  rtusim area                                     the default machine, beside all presets\n"
    "  rtusim area --set rtu.box.boxes_per_cycle=2     half the box lanes\n"
    "  rtusim area builtin                             with the built-in scene, in every mode of the pair "
    "unit\n"
    "  rtusim area bunny.glb dragon.glb --charts out   what sharing the common edge is worth, SVG and PNG\n"
    "  rtusim area bunny.glb --html area.html          one page with all tables and charts\n"
    "  rtusim area --json - | jq '.presets[] | {name, gates}'\n";

struct AreaArguments {
    std::vector<std::string> scenes;
    MachineOptions machine;
    std::string workloads = "primary,shadow,diffuse";
    std::string resolution = "128x128";
    std::string camera;
    std::string seed = "1";
    unsigned threads = 0;
    ReportOutput output;
    ChartFiles charts;
};

void add_options(CLI::App& area, AreaArguments& arguments) {
    area.add_option("SCENE", arguments.scenes,
                    "glTF 2.0 files (.gltf, .glb) to simulate, or `builtin`; none: areas only")
        ->type_name("");
    add_machine_options(area, arguments.machine);
    add_workloads_option(area, arguments.workloads);
    add_resolution_option(area, arguments.resolution);
    add_camera_option(area, arguments.camera);
    add_seed_option(area, arguments.seed);
    add_report_options(area, arguments.output);
    add_chart_file_options(area, arguments.charts);
    add_threads_option(area, arguments.threads);
}

study::AreaOptions options_of(const AreaArguments& arguments) {
    study::AreaOptions options;
    options.preset = arguments.machine.preset;
    options.config = load(arguments.machine).config;
    for (const std::string& name : sim::preset_names()) {
        options.presets.push_back({name, sim::load_config(name, std::nullopt, {}).config});
    }
    options.scenes = parse_scenes_or_builtin(arguments.scenes);
    options.workloads = parse_workloads(arguments.workloads);
    options.resolution = parse_resolution(arguments.resolution);
    options.seed = parse_seed(arguments.seed);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, options.scenes);
    check_scene_names(options.scenes);
    return options;
}

study::AreaReport measure(study::AreaOptions& options) {
    Progress progress;
    options.progress = [&](std::string_view scene, std::string_view phase) { progress.show(scene, phase); };
    return study::run_area_study(options);
}

int run_area(const AreaArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::AreaOptions options = options_of(arguments);
    const auto inputs = input_files(options.scenes, {arguments.camera, arguments.machine.file});
    check_report_output(arguments.output, inputs);
    check_chart_files(arguments.charts, arguments.output, inputs);
    const ThreadLimit limit(arguments.threads);
    const study::AreaReport report = measure(options);
    std::vector<study::OutputFile> files;
    if (!arguments.charts.html.empty()) files.push_back({arguments.charts.html, study::area_html(report)});
    add_charts(arguments.charts, study::area_charts(report), files);
    write_report(arguments.output, study::area_text(report), study::area_json(report),
                 study::area_csv(report), files);
    return exit_done;
}

}  // namespace

void add_area_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<AreaArguments>();
    CLI::App* area = app.add_subcommand("area", area_description);
    area->footer(area_footer);
    area->get_formatter()->column_width(34);
    add_options(*area, *arguments);
    area->callback([arguments, &command] { command = [arguments] { return run_area(*arguments); }; });
}

}  // namespace rtu::apps
