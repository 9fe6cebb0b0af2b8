#include "apps/timeline_command.hpp"

#include <memory>
#include <optional>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/run_options.hpp"
#include "apps/run_plan.hpp"
#include "apps/standard_output.hpp"
#include "model/error.hpp"
#include "study/output_file.hpp"
#include "study/timeline/timeline_output.hpp"
#include "study/timeline/timeline_study.hpp"

namespace rtu::apps {
namespace {

constexpr const char* timeline_description =
    "show what each unit and ray slot does, cycle by cycle, in a window of a run: as a trace for Perfetto "
    "and\n"
    "chrome://tracing (--json), and as waveforms of the units' states and channels (--vcd)";

constexpr const char* timeline_footer =
    "Examples:\n"
    "  rtusim timeline --json t.json                          the first 2,000 cycles; open it at "
    "ui.perfetto.dev\n"
    "  rtusim timeline bunny.glb --from 100000 --cycles 500 --json t.json --vcd t.vcd\n"
    "  rtusim timeline --workload shadow --set l1.mshrs=4 --vcd t.vcd && vcd2fst t.vcd t.fst\n"
    "  rtusim timeline --json - | jq '[.traceEvents[] | select(.cat == \"read\")] | length'\n";

constexpr sim::Cycle most_cycles = 1'000'000;

struct TimelineArguments {
    RunArguments run;
    study::TimelineWindow window;
    std::string json, vcd;
};

void check_outputs(const TimelineArguments& arguments, const RunPlan& plan) {
    for (const std::string& name : {arguments.json, arguments.vcd}) {
        if (!name.empty() && name != "-") check_output(name, plan.inputs);
    }
    if (!arguments.json.empty() && !arguments.vcd.empty() && is_same_file(arguments.json, arguments.vcd)) {
        throw Error("{}: --json and --vcd name the same file", arguments.json);
    }
}

int run_timeline(const TimelineArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    RunPlan plan = make_run_plan(arguments.run);
    if (plan.options.workloads.size() > 1) {
        throw Error("--workload: expected one workload, got '{}'", arguments.run.workloads);
    }
    check_outputs(arguments, plan);
    const ThreadLimit limit(plan.threads);
    study::Timeline timeline;
    {
        Progress progress;
        const study::SceneSource& scene = plan.scenes.front();
        plan.options.progress = [&](std::string_view phase) { progress.show(scene.name(), phase); };
        timeline = study::run_timeline(plan.options, scene, arguments.window);
    }
    const std::string json = arguments.json.empty() ? "" : study::timeline_json(timeline);
    std::vector<study::OutputFile> files;
    if (!json.empty() && arguments.json != "-") files.push_back({arguments.json, json});
    if (!arguments.vcd.empty()) files.push_back({arguments.vcd, study::timeline_vcd(timeline)});
    study::write_files(files);
    print_all(arguments.json == "-" ? json : study::timeline_text(timeline));
    return exit_done;
}

void add_window_options(CLI::App& timeline, TimelineArguments& arguments) {
    timeline.add_option("--from", arguments.window.from, "first cycle of the window")
        ->type_name("CYCLE")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 48))
        ->capture_default_str();
    timeline.add_option("--cycles", arguments.window.cycles, "its length, at most 1,000,000")
        ->type_name("N")
        ->check(CLI::Range(sim::Cycle{1}, most_cycles))
        ->capture_default_str();
    timeline.add_option("--json", arguments.json, "write a trace for Perfetto; -: to standard output")
        ->type_name("FILE")
        ->check(is_not_empty());
    timeline.add_option("--vcd", arguments.vcd, "write waveforms, for GTKWave and others")
        ->type_name("FILE")
        ->check(is_not_empty());
}

}  // namespace

void add_timeline_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<TimelineArguments>();
    arguments->run.workloads = "primary";
    CLI::App* timeline = app.add_subcommand("timeline", timeline_description);
    timeline->footer(timeline_footer);
    timeline->get_formatter()->column_width(34);
    timeline
        ->add_option("SCENE", arguments->run.scenes,
                     "a glTF 2.0 file (.gltf, .glb); none: the built-in scene")
        ->type_name("")
        ->expected(0, 1);
    add_window_options(*timeline, *arguments);
    CLI::Option* rays = timeline
                            ->add_option("--rays", arguments->run.rays,
                                         "the rays of a file (see `rtusim trace`) instead of a workload")
                            ->type_name("FILE")
                            ->check(is_not_empty());
    add_tree_options(*timeline, arguments->run);
    add_picture_options(*timeline, arguments->run, rays);
    add_ray_input_options(*timeline, arguments->run, rays);
    add_machine_options(*timeline, arguments->run.machine);
    add_link_option(*timeline, arguments->run.machine);
    add_host_options(*timeline, arguments->run);
    timeline->callback([arguments, &command] { command = [arguments] { return run_timeline(*arguments); }; });
}

}  // namespace rtu::apps
