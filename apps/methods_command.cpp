#include "apps/methods_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/report_output.hpp"
#include "model/error.hpp"
#include "study/methods/methods_study.hpp"
#include "study/methods/methods_text.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

constexpr const char* methods_description =
    "measure how many ray-triangle tests a second each intersection method does on this host,\n"
    "one by one, in packets of rays, over wide leaves and in pairs";

struct MethodsArguments {
    std::vector<std::string> scenes;
    std::string methods, forms;
    std::uint32_t triangle_count = 1024, ray_count = 256, repeats = 7;
    std::string workloads = "primary,diffuse";
    std::string camera;
    std::string seed = "1";
    ReportOutput output;
};

std::string methods_footer() {
    std::string text = "Methods:\n";
    for (const auto& method : model::methods::all_methods())
        text += fmt::format("  {:<26}{}, {}\n", method.info.name, method.info.title, method.info.source);
    return text +
           "\nForms:\n"
           "  single                    one ray, one triangle\n"
           "  rays                      4, 8 or 16 rays, one triangle: packets\n"
           "  triangles                 one ray, 4, 8 or 16 triangles: a wide leaf\n"
           "  pairs                     one ray, 1, 4, 8 or 16 pairs of triangles with a common edge\n"
           "\nExamples:\n"
           "  rtusim methods                                     every method in every form\n"
           "  rtusim methods --method wald,woop --form single    two of them, one by one\n"
           "  rtusim methods bunny.glb --workload diffuse        on the leaves that a scene's rays visit, "
           "too\n"
           "  rtusim methods --json - | jq '.rows[] | {method, form, width, mtests_per_second}'\n";
}

void add_options(CLI::App& methods, MethodsArguments& arguments) {
    methods
        .add_option("SCENE", arguments.scenes,
                    "glTF 2.0 files (.gltf, .glb): 1,024 of their rays are measured on their own leaves, too")
        ->type_name("");
    methods.add_option("--method", arguments.methods, "only these, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    methods.add_option("--form", arguments.forms, "only these, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    methods.add_option("--triangles", arguments.triangle_count, "of the random workload; an even number")
        ->type_name("N")
        ->check(CLI::Range(2, 1 << 20))
        ->capture_default_str();
    methods.add_option("--rays", arguments.ray_count, "of the random workload")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    methods.add_option("--repeats", arguments.repeats, "the least time counts")
        ->type_name("N")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    methods
        .add_option("--workload", arguments.workloads,
                    "a scene's rays, of primary, shadow, ao, diffuse, random")
        ->type_name("LIST")
        ->capture_default_str();
    add_camera_option(methods, arguments.camera);
    add_seed_option(methods, arguments.seed);
    add_report_options(methods, arguments.output);
}

study::MethodsOptions options_of(const MethodsArguments& arguments) {
    study::MethodsOptions options;
    options.methods = parse_list("--method", arguments.methods);
    std::ranges::for_each(options.methods, study::check_method_name);
    for (const std::string& form : parse_list("--form", arguments.forms))
        options.forms.push_back(study::parse_form(form));
    if (arguments.triangle_count % 2 != 0)
        throw Error("--triangles: expected an even number, got {}", arguments.triangle_count);
    options.triangle_count = arguments.triangle_count;
    options.ray_count = arguments.ray_count;
    options.repeats = arguments.repeats;
    options.seed = parse_seed(arguments.seed);
    if (!arguments.scenes.empty()) options.scenes = parse_scenes(arguments.scenes);
    options.workloads = parse_workloads(arguments.workloads);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, options.scenes);
    return options;
}

study::MethodsReport measure(study::MethodsOptions& options) {
    Progress progress;
    options.progress = [&](std::string_view phase) { progress.show("methods", phase); };
    return study::run_methods_study(options);
}

int run_methods(const MethodsArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::MethodsOptions options = options_of(arguments);
    std::vector<std::filesystem::path> inputs(arguments.scenes.begin(), arguments.scenes.end());
    if (!arguments.camera.empty()) inputs.emplace_back(arguments.camera);
    check_report_output(arguments.output, inputs);
    const study::MethodsReport report = measure(options);
    write_report(arguments.output, study::methods_text(report), study::methods_json(report),
                 study::methods_csv(report));
    return exit_done;
}

}  // namespace

void add_methods_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<MethodsArguments>();
    CLI::App* methods = app.add_subcommand("methods", methods_description);
    methods->footer(methods_footer());
    methods->get_formatter()->column_width(34);
    add_options(*methods, *arguments);
    methods->callback([arguments, &command] { command = [arguments] { return run_methods(*arguments); }; });
}

}  // namespace rtu::apps
