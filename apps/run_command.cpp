#include "apps/run_command.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "apps/exit_code.hpp"
#include "apps/progress.hpp"
#include "apps/run_plan.hpp"
#include "apps/standard_output.hpp"
#include "study/output_file.hpp"
#include "study/picture.hpp"
#include "study/report_csv.hpp"
#include "study/report_json.hpp"
#include "study/report_text.hpp"
#include "study/scene_run.hpp"

namespace rtu::apps {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  rtusim run                                          the built-in scene\n"
    "  rtusim run bunny.glb --pairing window:2 --check     the hits verified\n"
    "  rtusim run *.glb --camera scenes.toml --csv all.csv several scenes, one row a scene and workload\n"
    "  rtusim run bunny.glb --image out                    out/bunny_normal.png, out/bunny_box_tests.png\n"
    "  rtusim run --set rtu.box.boxes_per_cycle=8          a machine with a wider box unit\n"
    "  rtusim run bunny.glb --json - | jq .total           pure JSON on standard output\n";

void add_scene_options(CLI::App& run, RunArguments& arguments) {
    run.add_option("SCENE", arguments.scenes, "glTF 2.0 files (.gltf, .glb); none: the built-in scene")
        ->type_name("");
    run.add_option("--pairing", arguments.pairing,
                   "how triangles become pairs: " + std::string(model::pairing_method_names))
        ->type_name("METHOD")
        ->capture_default_str();
    run.add_option("--edge-identity", arguments.edge_identity,
                   "corners are one vertex by position (bit-equal) or by index (the file's)")
        ->type_name("KIND")
        ->capture_default_str();
    run.add_option("--workload", arguments.workloads,
                   "rays to trace, of primary, shadow, ao, diffuse, random")
        ->type_name("LIST")
        ->capture_default_str();
    run.add_option("--resolution", arguments.resolution, "picture size in pixels, one primary ray each")
        ->type_name("WxH")
        ->capture_default_str();
    run.add_option("--camera", arguments.camera,
                   "TOML with eye, target, up, tan_half_fov, in a table named like the scene;\n"
                   "without it, or without the scene's table, the camera is automatic")
        ->type_name("FILE")
        ->check(is_not_empty());
    run.add_option("--seed", arguments.seed, "of the random numbers of ao, diffuse and random rays")
        ->type_name("N")
        ->capture_default_str();
}

void add_output_options(CLI::App& run, RunArguments& arguments) {
    run.add_option("--json", arguments.json,
                   "write the report as JSON; - is standard output, and no text then")
        ->type_name("FILE|-")
        ->check(is_not_empty());
    run.add_option("--csv", arguments.csv, "write the report as CSV, a row for each scene and workload")
        ->type_name("FILE")
        ->check(is_not_empty());
    run.add_option("--image", arguments.image_folder,
                   "write SCENE_normal.png and SCENE_box_tests.png there; made if missing")
        ->type_name("DIR")
        ->check(is_not_empty());
    run.add_flag(
        "--check", arguments.is_checked,
        "compare every hit with the reference traversal and with Embree;\na difference is exit code 3");
}

void add_host_options(CLI::App& run, RunArguments& arguments) {
    run.add_option("--clock-mode", arguments.clock_mode,
                   "fast, or verify: a clocked process for each unit, same results, slower")
        ->type_name("MODE")
        ->capture_default_str();
    run.add_option("--threads", arguments.threads, "host threads at most, 0: all; no effect on results")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

std::vector<study::SceneReport> run_scenes(RunPlan& plan) {
    Progress progress;
    std::vector<study::SceneReport> reports;
    for (const study::SceneSource& scene : plan.scenes) {
        plan.options.progress = [&](std::string_view phase) { progress.show(scene.name(), phase); };
        reports.push_back(study::run_scene(plan.options, scene));
    }
    return reports;
}

void write_outputs(const RunPlan& plan, const std::vector<study::SceneReport>& reports) {
    std::vector<study::OutputFile> files;
    if (plan.json) files.push_back({*plan.json, study::json_report(reports)});
    if (plan.csv) files.push_back({*plan.csv, study::csv_report(reports)});
    if (plan.image_folder) {
        for (const study::SceneReport& report : reports) {
            const study::PixelData& pixels = report.pixels.value();
            const auto path = [&](const char* kind) {
                return *plan.image_folder / fmt::format("{}_{}.png", report.scene.name, kind);
            };
            files.push_back({path("normal"), to_png(normal_picture(pixels))});
            files.push_back({path("box_tests"), to_png(heat_map(pixels))});
        }
    }
    study::write_files(files);
}

int run(const RunArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    RunPlan plan = make_run_plan(arguments);
    std::optional<tbb::global_control> limit;
    if (plan.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, plan.threads);

    const std::vector<study::SceneReport> reports = run_scenes(plan);
    write_outputs(plan, reports);
    print_all(plan.is_json_to_stdout ? study::json_report(reports) : study::text_report(reports));
    const bool is_clean = std::all_of(reports.begin(), reports.end(), [](const study::SceneReport& report) {
        return report.check.value_or(study::CheckReport{}).is_clean();
    });
    if (is_clean) return exit_done;
    print_error("the check found differences: see `check` in the report");
    return exit_internal;
}

}  // namespace

void add_run_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* run_app = app.add_subcommand("run", "simulate scenes and report tests, cycles and MRPS");
    run_app->footer(footer);
    run_app->get_formatter()->column_width(34);
    add_scene_options(*run_app, *arguments);
    add_machine_options(*run_app, arguments->machine);
    add_output_options(*run_app, *arguments);
    add_host_options(*run_app, *arguments);
    run_app->callback([arguments, &command] { command = [arguments] { return run(*arguments); }; });
}

}  // namespace rtu::apps
