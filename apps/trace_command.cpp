#include "apps/trace_command.hpp"

#include <memory>

#include "apps/common_options.hpp"
#include "apps/machine_options.hpp"
#include "apps/run_command.hpp"
#include "apps/run_options.hpp"
#include "apps/trace_jobs.hpp"

namespace rtu::apps {
namespace {

constexpr const char* trace_help =
    "record rays or traversals, replay them on any machine, exchange them with other programs";

constexpr const char* trace_footer =
    "A ray trace holds the rays of a run, workload after workload. Replayed on the same machine it gives "
    "the\n"
    "run's hits, counts and cycles; on another machine the same hits, and the same counts as long as tree "
    "and\n"
    "pairing are the same. A traversal trace (record --visits) holds what each ray visits: its replay "
    "computes\n"
    "nothing but timing, and is bound to one scene, pairing and tree.\n"
    "docs/traces.md describes the formats, and how to make rays with NumPy.\n\n"
    "Examples:\n"
    "  rtusim trace record bunny.glb bunny.rtutrace         the rays that `rtusim run bunny.glb` simulates\n"
    "  rtusim trace replay bunny.rtutrace bunny.glb         the same report as of that run\n"
    "  rtusim trace convert rays.npy rays.rtutrace          a NumPy array of shape [ray_count, 8]\n"
    "  rtusim trace verify bunny.rtutrace.partial --recover saved.rtutrace\n\n"
    "`rtusim trace COMMAND --help` tells each command's options.";

constexpr const char* record_footer =
    "Examples:\n"
    "  rtusim trace record bunny.glb bunny.rtutrace --workload primary,ao --resolution 1024x1024\n"
    "  rtusim trace record bunny.glb bunny.visits.rtutrace --visits --set bvh.width=8\n"
    "  rtusim trace record bunny.glb peer.visits.rtutrace --visits --rays peer.rays7\n"
    "  rtusim trace record - builtin.rtutrace               the built-in scene\n\n"
    "While it is written the trace is called OUT.partial. What an interrupted recording leaves under that\n"
    "name can be saved: rtusim trace verify OUT.partial --recover OUT";

constexpr const char* replay_footer =
    "Examples:\n"
    "  rtusim trace replay bunny.rtutrace bunny.glb --check\n"
    "  rtusim trace replay bunny.rtutrace bunny.glb --preset rdna4 --json -\n"
    "  rtusim trace replay cornell.rays7 cornell.glb --kind closest\n";

constexpr const char* verify_footer =
    "A fault is reported with its offset, and the exit code is 1. --recover saves every whole chunk, before\n"
    "and behind faults, to a new trace.\n\n"
    "Examples:\n"
    "  rtusim trace verify bunny.rtutrace\n"
    "  rtusim trace verify bunny.rtutrace.partial --recover saved.rtutrace\n";

constexpr const char* convert_footer =
    "Formats, by extension or by --from and --to:\n"
    "  .rtutrace  trace   the format of this program, the only one that keeps all of a trace\n"
    "  .rays7     rays7   7 little-endian float32 a ray: origin, direction, t_max; t_min is 0\n"
    "  .rays8     rays8   8 little-endian float32 a ray: origin, t_min, direction, t_max\n"
    "  .npy       npy     the same as a NumPy array of shape [ray_count, 8], float32\n"
    "  .csv       csv     a header line with origin_x,...; a line a ray\n"
    "  .jsonl     jsonl   a JSON object a line: {\"origin\": [0, 0, 0], \"direction\": [0, 0, 1]}\n\n"
    "Examples:\n"
    "  rtusim trace convert rays.npy rays.rtutrace --scene bunny.glb --name primary\n"
    "  rtusim trace convert shadow.rays7 shadow.rtutrace --kind any\n"
    "  rtusim trace convert bunny.rtutrace bunny.csv --workload primary\n";

CLI::App* add(CLI::App& trace, const char* name, const char* help, const char* footer) {
    CLI::App* command = trace.add_subcommand(name, help);
    command->footer(footer);
    command->get_formatter()->column_width(34);
    return command;
}

void add_record(CLI::App& trace, std::function<int()>& command) {
    auto arguments = std::make_shared<RecordArguments>();
    CLI::App* app =
        add(trace, "record", "write the rays of a run, or their traversals, to a trace", record_footer);
    app->add_option("SCENE", arguments->scene, "glTF 2.0 file (.gltf, .glb); - is the built-in scene")
        ->required()
        ->type_name("");
    app->add_option("OUT", arguments->output, "the trace to write")->required()->type_name("");
    app->add_flag("--visits", arguments->has_visits,
                  "a traversal trace: what each ray visits in the tree that\n"
                  "--pairing, --edge-identity and the machine's bvh keys give");
    CLI::Option* rays = app->add_option("--rays", arguments->run.rays, "the rays of a file, not of workloads")
                            ->type_name("FILE")
                            ->check(is_not_empty());
    add_tree_options(*app, arguments->run);
    add_picture_options(*app, arguments->run, rays);
    add_ray_input_options(*app, arguments->run, rays);
    add_machine_options(*app, arguments->run.machine);
    add_threads_option(*app, arguments->run.threads);
    app->callback([arguments, &command] {
        if (arguments->scene == "-") arguments->scene.clear();
        command = [arguments] { return record_trace(*arguments); };
    });
}

void add_replay(CLI::App& trace, std::function<int()>& command) {
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* app =
        add(trace, "replay", "simulate the rays of a file on any machine; the report is that of `rtusim run`",
            replay_footer);
    app->add_option("TRACE", arguments->rays, "a trace of rays or traversals, or rays of another format")
        ->required()
        ->type_name("")
        ->check(is_not_empty());
    app->add_option("SCENE", arguments->scenes, "glTF 2.0 file (.gltf, .glb); none: the built-in scene")
        ->expected(0, 1)
        ->type_name("");
    add_ray_input_options(*app, *arguments, nullptr);
    add_tree_options(*app, *arguments);
    add_machine_options(*app, arguments->machine);
    add_link_option(*app, arguments->machine);
    add_output_options(*app, *arguments);
    add_host_options(*app, *arguments);
    app->callback([arguments, &command] { command = [arguments] { return run_scenes(*arguments); }; });
}

void add_info(CLI::App& trace, std::function<int()>& command) {
    auto arguments = std::make_shared<InspectArguments>();
    CLI::App* app = add(trace, "info", "print where a trace comes from and what it holds", "");
    app->add_option("TRACE", arguments->file, "the trace")->required()->type_name("");
    app->callback([arguments, &command] { command = [arguments] { return print_trace_info(*arguments); }; });
}

void add_verify(CLI::App& trace, std::function<int()>& command) {
    auto arguments = std::make_shared<InspectArguments>();
    CLI::App* app =
        add(trace, "verify", "check every byte of a trace, and save what is whole", verify_footer);
    app->add_option("TRACE", arguments->file, "the trace")->required()->type_name("");
    app->add_option("--recover", arguments->recovered, "write every whole chunk to a new trace")
        ->type_name("OUT")
        ->check(is_not_empty());
    app->callback([arguments, &command] { command = [arguments] { return verify_trace(*arguments); }; });
}

void add_convert(CLI::App& trace, std::function<int()>& command) {
    auto arguments = std::make_shared<ConvertArguments>();
    CLI::App* app = add(trace, "convert", "bring rays from one format to another", convert_footer);
    app->add_option("IN", arguments->input, "rays")->required()->type_name("");
    app->add_option("OUT", arguments->output, "the file to write")->required()->type_name("");
    app->add_option("--from", arguments->from, "format of IN")->type_name("NAME");
    app->add_option("--to", arguments->to, "format of OUT")->type_name("NAME");
    app->add_option("--kind", arguments->kind, "of rays whose file does not say: closest hit or any hit")
        ->type_name("closest|any")
        ->capture_default_str();
    app->add_option("--name", arguments->name, "of the workload of rays whose file does not say")
        ->type_name("NAME")
        ->capture_default_str();
    app->add_option("--workload", arguments->workload, "take the rays of this workload only")
        ->type_name("NAME")
        ->check(is_not_empty());
    CLI::Option* scene =
        app->add_option("--scene", arguments->scene, "tie the trace to this scene: others are refused")
            ->type_name("FILE")
            ->check(is_not_empty());
    app->add_flag("--builtin-scene", arguments->is_builtin_scene, "tie it to the built-in scene")
        ->excludes(scene);
    app->callback([arguments, &command] { command = [arguments] { return convert_rays(*arguments); }; });
}

}  // namespace

void add_trace_command(CLI::App& app, std::function<int()>& command) {
    CLI::App* trace = app.add_subcommand("trace", trace_help);
    trace->footer(trace_footer);
    trace->require_subcommand(1);
    add_record(*trace, command);
    add_replay(*trace, command);
    add_info(*trace, command);
    add_verify(*trace, command);
    add_convert(*trace, command);
}

}  // namespace rtu::apps
