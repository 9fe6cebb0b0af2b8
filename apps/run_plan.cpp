#include "apps/run_plan.hpp"

#include <set>
#include <string_view>

#include "apps/option_values.hpp"
#include "model/error.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;

sim::ClockMode parse_clock_mode(std::string_view text) {
    if (text == "fast") return sim::ClockMode::Fast;
    if (text == "verify") return sim::ClockMode::Verify;
    throw Error("--clock-mode: expected fast or verify, got '{}'", text);
}

void check_outputs(const RunPlan& plan) {
    for (const auto& output : {plan.json, plan.csv}) {
        if (output) check_output(*output, plan.inputs);
    }
    if (plan.json && plan.csv && is_same_file(*plan.json, *plan.csv)) {
        throw Error("{}: --json and --csv name the same file", plan.csv->string());
    }
    if (!plan.image_folder) return;
    study::check_writable_folder(*plan.image_folder);
    std::set<std::string> names;
    for (const study::SceneSource& scene : plan.scenes) {
        if (!names.insert(scene.name()).second) {
            throw Error("--image: two scenes are called '{}', so their pictures would be too", scene.name());
        }
    }
}

// What an estimate cannot do is refused: only a run of every ray has hits, pictures and counters.
void take_fidelity(const RunArguments& arguments, RunPlan& plan) {
    plan.fidelity = parse_fidelity(arguments.fidelity);
    if (!arguments.tolerance.empty()) {
        const bool uses_it =
            plan.fidelity == study::FidelityLevel::Sampled || plan.fidelity == study::FidelityLevel::Auto;
        if (!uses_it) throw Error("--tolerance: needs --fidelity sampled or auto");
        plan.tolerance = parse_tolerance(arguments.tolerance);
    }
    if (plan.fidelity == study::FidelityLevel::Cycle) return;
    const std::string needs = "needs --fidelity cycle, which simulates every ray";
    if (arguments.is_checked) throw Error("--check: {}", needs);
    if (!arguments.image_folder.empty()) throw Error("--image: {}", needs);
    if (arguments.clock_mode != "fast") throw Error("--clock-mode: {}", needs);
}

}  // namespace

RunPlan make_run_plan(const RunArguments& arguments) {
    RunPlan plan;
    study::RunOptions& options = plan.options;
    options.pairing = model::parse_pairing_method(arguments.pairing);
    options.edge_identity = model::parse_edge_identity(arguments.edge_identity);
    options.workloads = parse_workloads(arguments.workloads);
    options.resolution = parse_resolution(arguments.resolution);
    options.seed = parse_seed(arguments.seed);
    options.preset = arguments.machine.preset;
    options.config = load(arguments.machine).config;
    options.clock_mode = parse_clock_mode(arguments.clock_mode);
    options.is_checked = arguments.is_checked;
    options.wants_pixels = !arguments.image_folder.empty();
    options.camera_file = optional_path(arguments.camera);

    if (!arguments.rays.empty()) {
        options.rays =
            parse_ray_input(arguments.rays, arguments.rays_format, arguments.ray_kind, arguments.is_forced);
    }

    plan.scenes = parse_scenes(arguments.scenes);
    check_cameras(options.camera_file, plan.scenes);
    for (const std::string& name : arguments.scenes) plan.inputs.emplace_back(name);
    for (const std::string& name : {arguments.camera, arguments.machine.file, arguments.rays}) {
        if (!name.empty()) plan.inputs.emplace_back(name);
    }
    plan.threads = arguments.threads;
    plan.is_json_to_stdout = arguments.json == "-";
    if (!plan.is_json_to_stdout) plan.json = optional_path(arguments.json);
    plan.csv = optional_path(arguments.csv);
    plan.image_folder = optional_path(arguments.image_folder);
    take_fidelity(arguments, plan);
    check_outputs(plan);
    return plan;
}

}  // namespace rtu::apps
