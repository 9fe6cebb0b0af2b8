#include "apps/validate_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
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
#include "apps/standard_output.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "study/output_file.hpp"
#include "study/validate/validate_configs.hpp"
#include "study/validate/validate_output.hpp"
#include "study/validate/validate_study.hpp"

namespace rtu::apps {
namespace {

constexpr const char* validate_description =
    "run the same rays through the simulator and the Verilated RTU, on many machines: hits and counts must "
    "be\n"
    "the same, cycles should be; a difference in hits or counts is exit code 3";

struct ValidateArguments {
    std::vector<std::string> scenes;
    std::string only;
    std::vector<std::string> sim_sets;
    std::uint32_t rays = study::ValidateOptions{}.ray_count;
    std::string workloads = "primary,shadow,diffuse";
    std::string camera;
    std::string seed = "1";
    std::string waves;
    std::string window = "0:10000";
    ReportOutput output;
    ChartFiles charts;
};

std::string validate_footer() {
    std::string text = "Machines (--only), each against base:\n";
    for (const study::ValidateConfig& config : study::validate_configs()) {
        text += fmt::format("  {:<20}", config.name);
        for (const std::string& set : config.sets) text += set + " ";
        text.back() = '\n';
    }
    return text +
           "\nExamples:\n"
           "  rtusim validate                                 the built-in scene on every machine\n"
           "  rtusim validate bunny.glb dragon.glb --html validation.html\n"
           "  rtusim validate --only base --workload primary --waves rtu.fst --window 1000:2000\n"
           "                                                  signals of the RTL, for a waveform viewer\n"
           "  rtusim validate --only base,stack_2 --rays 500  quicker\n"
           "  rtusim validate --only base --sim-set rtu.scheduler.latency_cycles=0\n"
           "                                                  what the scheduler's stages are worth\n"
           "  rtusim validate --json - | jq .summary\n";
}

void add_options(CLI::App& validate, ValidateArguments& arguments) {
    add_scenes_option(validate, arguments.scenes);
    validate.add_option("--only", arguments.only, "only these machines, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    validate
        .add_option("--sim-set", arguments.sim_sets,
                    "change the simulator only: what its cycles would be off by with this number; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->check(is_not_empty());
    validate
        .add_option("--rays", arguments.rays,
                    "of each workload at most, spread over the picture; with fewer than 16 slots fewer")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    add_workloads_option(validate, arguments.workloads);
    add_camera_option(validate, arguments.camera);
    add_seed_option(validate, arguments.seed);
    validate
        .add_option("--waves", arguments.waves,
                    "record the RTL's signals in FILE.fst or FILE.vcd: of one scene, workload and machine "
                    "(4 wide, dual_shared)")
        ->type_name("FILE")
        ->check(is_not_empty());
    validate.add_option("--window", arguments.window, "the cycles that --waves records")
        ->type_name("FROM:TO")
        ->capture_default_str();
    add_report_options(validate, arguments.output);
    add_chart_file_options(validate, arguments.charts);
}

std::vector<study::ValidateConfig> parse_configs(const std::string& text) {
    std::vector<study::ValidateConfig> known = study::validate_configs();
    const std::vector<std::string> names = parse_list("--only", text);
    if (names.empty()) return known;
    std::vector<study::ValidateConfig> chosen;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(known, name, &study::ValidateConfig::name);
        if (found == known.end()) {
            throw Error("--only: expected machines as `rtusim validate --help` lists them, got '{}'", name);
        }
        chosen.push_back(*found);
    }
    return chosen;
}

std::optional<std::uint64_t> parse_cycle(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc{} && end == text.data() + text.size();
    return is_number ? std::optional(value) : std::nullopt;
}

std::optional<study::WaveWindow> parse_waves(const ValidateArguments& arguments,
                                             const study::ValidateOptions& options) {
    if (arguments.waves.empty()) return std::nullopt;
    if (options.scenes.size() != 1 || options.workloads.size() != 1 || options.configs.size() != 1) {
        throw Error("--waves: expected one scene, one --workload and one machine (--only), got {}, {} and {}",
                    options.scenes.size(), options.workloads.size(), options.configs.size());
    }
    const std::filesystem::path file = arguments.waves;
    if (file.extension() != ".fst" && file.extension() != ".vcd") {
        throw Error("--waves: expected a name that ends in .fst or .vcd, got '{}'",
                    model::one_line(arguments.waves));
    }
    const std::string_view window = arguments.window;
    const std::size_t colon = std::min(window.find(':'), window.size());
    const auto first = parse_cycle(window.substr(0, colon));
    const auto end = parse_cycle(window.substr(std::min(colon + 1, window.size())));
    if (!first || !end || *first >= *end) {
        throw Error("--window: expected FROM:TO, two cycles, FROM below TO, got '{}'",
                    model::one_line(window));
    }
    return study::WaveWindow{file, *first, *end};
}

study::ValidateOptions options_of(const ValidateArguments& arguments) {
    study::ValidateOptions options;
    options.scenes = parse_scenes(arguments.scenes);
    options.workloads = parse_workloads(arguments.workloads);
    options.configs = parse_configs(arguments.only);
    options.sim_sets = arguments.sim_sets;
    for (study::ValidateConfig& config : options.configs) {
        if (!options.sim_sets.empty()) config.simulated = study::simulated_instead(config, options.sim_sets);
    }
    options.ray_count = arguments.rays;
    options.seed = parse_seed(arguments.seed);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, options.scenes);
    check_scene_names(options.scenes);
    options.reference = study::rtl_reference(parse_waves(arguments, options));
    return options;
}

study::ValidateReport measure(study::ValidateOptions& options) {
    Progress progress;
    options.progress = [&](std::string_view scene, std::string_view phase) { progress.show(scene, phase); };
    return study::run_validation(options);
}

int run_validate(const ValidateArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::ValidateOptions options = options_of(arguments);
    std::vector<std::filesystem::path> inputs(arguments.scenes.begin(), arguments.scenes.end());
    if (!arguments.camera.empty()) inputs.emplace_back(arguments.camera);
    if (!arguments.waves.empty()) check_output(arguments.waves, inputs);
    check_report_output(arguments.output, inputs);
    check_chart_files(arguments.charts, arguments.output, inputs);
    const study::ValidateReport report = measure(options);
    std::vector<study::OutputFile> files;
    if (!arguments.charts.html.empty())
        files.push_back({arguments.charts.html, study::validate_html(report)});
    add_charts(arguments.charts, study::validate_charts(report), files);
    write_report(arguments.output, study::validate_text(report), study::validate_json(report),
                 study::validate_csv(report), files);
    if (!report.difference) return exit_done;
    print_error(study::validate_answer(report));
    return exit_internal;
}

}  // namespace

void add_validate_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<ValidateArguments>();
    CLI::App* validate = app.add_subcommand("validate", validate_description);
    validate->footer(validate_footer);
    validate->get_formatter()->column_width(34);
    add_options(*validate, *arguments);
    validate->callback([arguments, &command] { command = [arguments] { return run_validate(*arguments); }; });
}

}  // namespace rtu::apps
