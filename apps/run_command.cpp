#include "apps/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/progress.hpp"
#include "apps/run_options.hpp"
#include "apps/run_plan.hpp"
#include "apps/standard_output.hpp"
#include "study/chart/picture.hpp"
#include "study/chart/pixel_json.hpp"
#include "study/fidelity/fidelity_output.hpp"
#include "study/output_file.hpp"
#include "study/report/report_csv.hpp"
#include "study/report/report_json.hpp"
#include "study/report/report_text.hpp"
#include "study/scene_estimate.hpp"
#include "study/scene_run.hpp"

namespace rtu::apps {
namespace {

constexpr const char* run_footer =
    "Examples:\n"
    "  rtusim run                                          the built-in scene\n"
    "  rtusim run bunny.glb --pairing window:2 --check     the hits verified\n"
    "  rtusim run *.glb --camera scenes.toml --csv all.csv several scenes, one row a scene and workload\n"
    "  rtusim run bunny.glb --image out                    out/bunny_normal.png, out/bunny_box_tests.png\n"
    "  rtusim run cornell.glb --rays peer.rays7            rays of another program\n"
    "  rtusim run --set rtu.box.boxes_per_cycle=8          a machine with a wider box unit\n"
    "  rtusim run bunny.glb --resolution 2048x2048 --fidelity auto --tolerance 2\n"
    "                                                      an estimate within 2 %, in a fraction of the "
    "time\n"
    "  rtusim run bunny.glb --json - | jq .total           pure JSON on standard output\n";

std::vector<study::SceneReport> simulate(RunPlan& plan) {
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
                return *plan.image_folder / fmt::format("{}_{}", report.scene.name, kind);
            };
            files.push_back({path("normal.png"), to_png(normal_picture(pixels))});
            files.push_back({path("box_tests.png"), to_png(heat_map(pixels))});
            files.push_back({path("box_tests.json"), study::box_tests_json(report.scene.name, pixels)});
        }
    }
    study::write_files(files);
}

// A level of fidelity below the cycle model: one estimate a workload.
int run_estimates(RunPlan& plan) {
    std::vector<study::FidelityRow> rows;
    {
        Progress progress;
        for (const study::SceneSource& scene : plan.scenes) {
            plan.options.progress = [&](std::string_view phase) { progress.show(scene.name(), phase); };
            const auto found = study::estimate_scene(plan.options, scene, plan.fidelity, plan.tolerance);
            rows.insert(rows.end(), found.begin(), found.end());
        }
    }
    std::vector<study::OutputFile> files;
    if (plan.json) files.push_back({*plan.json, study::estimates_json(rows)});
    if (plan.csv) files.push_back({*plan.csv, study::rows_csv(rows)});
    study::write_files(files);
    print_all(plan.is_json_to_stdout ? study::estimates_json(rows) : study::estimates_text(rows));
    return exit_done;
}

}  // namespace

int run_scenes(const RunArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    RunPlan plan = make_run_plan(arguments);
    const ThreadLimit limit(plan.threads);
    if (plan.fidelity != study::FidelityLevel::Cycle) return run_estimates(plan);
    const std::vector<study::SceneReport> reports = simulate(plan);
    write_outputs(plan, reports);
    print_all(plan.is_json_to_stdout ? study::json_report(reports) : study::text_report(reports));
    const bool is_clean = std::all_of(reports.begin(), reports.end(), [](const study::SceneReport& report) {
        return report.check.value_or(study::CheckReport{}).is_clean();
    });
    if (is_clean) return exit_done;
    print_error("the check found differences: see `check` in the report");
    return exit_internal;
}

void add_run_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* run_app = app.add_subcommand("run", "simulate scenes and report tests, cycles and MRPS");
    run_app->footer(run_footer);
    run_app->get_formatter()->column_width(34);
    add_scenes_option(*run_app, arguments->scenes);
    CLI::Option* rays =
        run_app
            ->add_option("--rays", arguments->rays,
                         "simulate the rays of a file (see `rtusim trace`) instead of workloads")
            ->type_name("FILE")
            ->check(is_not_empty());
    add_tree_options(*run_app, *arguments);
    add_picture_options(*run_app, *arguments, rays);
    add_ray_input_options(*run_app, *arguments, rays);
    add_machine_options(*run_app, arguments->machine);
    add_link_option(*run_app, arguments->machine);
    add_output_options(*run_app, *arguments);
    add_fidelity_options(*run_app, *arguments);
    add_host_options(*run_app, *arguments);
    run_app->callback([arguments, &command] { command = [arguments] { return run_scenes(*arguments); }; });
}

}  // namespace rtu::apps
