#include "apps/precision_command.hpp"

#include <fmt/format.h>

#include <algorithm>
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
#include "model/methods/emulated.hpp"
#include "study/output_file.hpp"
#include "study/precision/precision_ladder.hpp"
#include "study/precision/precision_output.hpp"

namespace rtu::apps {
namespace {

constexpr const char* precision_description =
    "tell the cheapest ray-triangle method and number format that is exact enough for a scene's rays:\n"
    "every method in exponents of 5, 8 and 10 bits and mantissas of 7 to 23, against the exact test";

struct PrecisionArguments {
    std::vector<std::string> scenes;
    std::string methods;
    std::uint32_t ray_count = study::PrecisionOptions{}.ray_count;
    double t_tolerance = study::PrecisionOptions{}.t_tolerance;
    double wrong_per_million = study::PrecisionOptions{}.wrong_per_million;
    std::string workloads = "primary,diffuse";
    std::string camera;
    std::string seed = "1";
    unsigned threads = 0;
    ReportOutput output;
};

std::string precision_footer() {
    std::string text = "Methods:\n";
    for (const auto& method : model::methods::emulated_methods()) {
        text += fmt::format("  {:<26}{}, {}\n", method.info.name, method.info.title, method.info.source);
    }
    return text +
           "\nExamples:\n"
           "  rtusim precision                                  what the built-in scene needs\n"
           "  rtusim precision bunny.glb --wrong 100 --rays 20000\n"
           "                                                    at most 100 of a million rays wrong\n"
           "  rtusim precision a.glb --method woop,wald --csv ladder.csv\n"
           "  rtusim precision a.glb --json - | jq '.answers[0].row.format'\n";
}

void add_study_options(CLI::App& precision, PrecisionArguments& arguments) {
    add_scenes_option(precision, arguments.scenes);
    precision.add_option("--method", arguments.methods, "only these, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    precision
        .add_option("--rays", arguments.ray_count,
                    "sampled of each workload, and as many aimed at edges and vertices")
        ->type_name("N")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    precision
        .add_option("--t-tolerance", arguments.t_tolerance, "how far a hit's t may be off, as a share of it")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    precision
        .add_option("--wrong", arguments.wrong_per_million,
                    "rays of a million that may be wrong, with 95 % confidence")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    add_workloads_option(precision, arguments.workloads);
    add_camera_option(precision, arguments.camera);
    add_seed_option(precision, arguments.seed);
}

void add_output_options(CLI::App& precision, PrecisionArguments& arguments) {
    add_report_options(precision, arguments.output);
    add_threads_option(precision, arguments.threads);
}

void check_methods(const std::vector<std::string>& names) {
    std::string known;
    for (const auto& method : model::methods::emulated_methods()) {
        known += fmt::format("{}{}", known.empty() ? "" : ", ", method.info.name);
    }
    for (const std::string& name : names) {
        const auto is_it = [&](const auto& method) { return method.info.name == name; };
        if (std::ranges::none_of(model::methods::emulated_methods(), is_it)) {
            throw Error("--method: expected one of {}, got '{}'", known, name);
        }
    }
}

study::PrecisionOptions options_of(const PrecisionArguments& arguments) {
    study::PrecisionOptions options;
    options.methods = parse_list("--method", arguments.methods);
    check_methods(options.methods);
    options.scenes = parse_scenes(arguments.scenes);
    options.workloads = parse_workloads(arguments.workloads);
    options.ray_count = arguments.ray_count;
    options.t_tolerance = arguments.t_tolerance;
    options.wrong_per_million = arguments.wrong_per_million;
    options.seed = parse_seed(arguments.seed);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, options.scenes);
    return options;
}

study::PrecisionReport measure(study::PrecisionOptions& options) {
    Progress progress;
    options.progress = [&](std::string_view phase) { progress.show("precision", phase); };
    return study::run_precision_study(options);
}

int run_precision(const PrecisionArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::PrecisionOptions options = options_of(arguments);
    std::vector<std::filesystem::path> inputs(arguments.scenes.begin(), arguments.scenes.end());
    if (!arguments.camera.empty()) inputs.emplace_back(arguments.camera);
    check_report_output(arguments.output, inputs);
    const ThreadLimit limit(arguments.threads);
    const study::PrecisionReport report = measure(options);
    write_report(arguments.output, study::precision_text(report), study::precision_json(report),
                 study::precision_csv(report));
    return exit_done;
}

}  // namespace

void add_precision_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<PrecisionArguments>();
    CLI::App* precision = app.add_subcommand("precision", precision_description);
    precision->footer(precision_footer());
    precision->get_formatter()->column_width(34);
    add_study_options(*precision, *arguments);
    add_output_options(*precision, *arguments);
    precision->callback(
        [arguments, &command] { command = [arguments] { return run_precision(*arguments); }; });
}

}  // namespace rtu::apps
