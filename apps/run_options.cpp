#include "apps/run_options.hpp"

#include <string>

#include "apps/common_options.hpp"
#include "apps/machine_options.hpp"
#include "model/pairing.hpp"

namespace rtu::apps {

void add_tree_options(CLI::App& run, RunArguments& arguments) {
    run.add_option("--pairing", arguments.pairing,
                   "how triangles become pairs: " + std::string(model::pairing_method_names))
        ->type_name("METHOD")
        ->capture_default_str();
    run.add_option("--edge-identity", arguments.edge_identity,
                   "corners are one vertex by position (bit-equal) or by index (the file's)")
        ->type_name("KIND")
        ->capture_default_str();
}

void add_picture_options(CLI::App& run, RunArguments& arguments, CLI::Option* rays) {
    for (CLI::Option* option :
         {add_workloads_option(run, arguments.workloads), add_resolution_option(run, arguments.resolution),
          add_camera_option(run, arguments.camera), add_seed_option(run, arguments.seed)}) {
        if (rays != nullptr) option->excludes(rays);
    }
}

void add_ray_input_options(CLI::App& command, RunArguments& arguments, CLI::Option* rays) {
    CLI::Option* format =
        command
            .add_option("--format", arguments.rays_format,
                        "of the rays: trace, rays7, rays8, csv, jsonl, npy; default: by content or extension")
            ->type_name("NAME");
    CLI::Option* kind = command
                            .add_option("--kind", arguments.ray_kind,
                                        "of rays whose file does not say: closest hit or any hit")
                            ->type_name("closest|any")
                            ->capture_default_str();
    CLI::Option* force =
        command.add_flag("--force", arguments.is_forced, "take a trace that was recorded on another scene");
    if (rays == nullptr) return;
    for (CLI::Option* option : {format, kind, force}) option->needs(rays);
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
                   "write SCENE_normal.png and SCENE_box_tests.png there, and SCENE_box_tests.json "
                   "for\n`rtusim report`; made if missing")
        ->type_name("DIR")
        ->check(is_not_empty());
    run.add_flag(
        "--check", arguments.is_checked,
        "compare every hit with the reference traversal and with Embree;\na difference is exit code 3");
}

void add_fidelity_options(CLI::App& command, RunArguments& arguments) {
    command
        .add_option("--fidelity", arguments.fidelity,
                    "cycle: every ray simulated; sampled: some, with a 95 % interval; analytic: none, a\n"
                    "queueing model; counts: peak rates only; auto: the cheapest within the tolerance;\n"
                    "rtl: few rays through the Verilated RTU")
        ->type_name("LEVEL")
        ->capture_default_str();
    command
        .add_option("--tolerance", arguments.tolerance,
                    "how far sampled and auto may be off, in % of MRPS, 0.6 to 50 (default 2)")
        ->type_name("PCT")
        ->check(is_not_empty());
}

void add_host_options(CLI::App& run, RunArguments& arguments) {
    run.add_option("--clock-mode", arguments.clock_mode,
                   "fast, or verify: a clocked process for each unit, same results, slower")
        ->type_name("MODE")
        ->capture_default_str();
    add_threads_option(run, arguments.threads);
}

}  // namespace rtu::apps
