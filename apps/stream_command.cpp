#include "apps/stream_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/progress.hpp"
#include "apps/report_output.hpp"
#include "apps/stream_command_plan.hpp"
#include "sim/presets.hpp"
#include "study/output_file.hpp"
#include "study/stream/stream_output.hpp"

namespace rtu::apps {
namespace {

constexpr const char* stream_description =
    "stream rays and triangles over a host link through the pair testers, without a BVH: every ray against\n"
    "every pair. How fast with and without the link, where the time goes, and which batch is large enough";

constexpr const char* stream_footer =
    "Modes:\n"
    "  direct     a ray and a pair go up for each test, and the host waits for the result\n"
    "  batched    a batch holds a ray and a pair for each of its tests\n"
    "  mixed      a block of rays stays in the machine while the pairs stream past it\n"
    "  resident   the pairs stay in the machine while the rays stream past them\n"
    "\nExamples:\n"
    "  rtusim stream                                      all modes on all links, built-in scene\n"
    "  rtusim stream bunny.glb --mode batched,mixed --link pcie4_x16,pcie5_x16\n"
    "  rtusim stream --batch 1024,65536 --read-back none  what read-back costs\n"
    "  rtusim stream --set link.buffers=1                 nothing overlaps\n"
    "  rtusim stream --published                          beside the rates of Robert and Schweri\n"
    "  rtusim stream --html stream.html --charts out      tables and charts\n"
    "  rtusim stream --json - | jq '.rows[] | {mode, link, batch_tests, tests_per_second, limit}'\n"
    "\nA BVH behind a link: rtusim run --link NAME\n";

void add_work_options(CLI::App& stream, StreamArguments& arguments) {
    stream.add_option("SCENE", arguments.scene, "glTF 2.0 file (.gltf, .glb); none: the built-in scene")
        ->type_name("");
    stream.add_option("--rays", arguments.ray_count, "of the workload, spread over it; or all it has")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    stream.add_option("--pairs", arguments.pair_count, "pairs and lone triangles, likewise of the scene")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    stream
        .add_option("--pairing", arguments.pairing,
                    "how triangles become pairs: " + std::string(model::pairing_method_names))
        ->type_name("METHOD")
        ->capture_default_str();
    stream
        .add_option("--edge-identity", arguments.edge_identity,
                    "corners are one vertex by position (bit-equal) or by index (the file's)")
        ->type_name("KIND")
        ->capture_default_str();
    stream.add_option("--workload", arguments.workload, "one of primary, shadow, ao, diffuse, random")
        ->type_name("NAME")
        ->capture_default_str();
    add_camera_option(stream, arguments.camera);
    add_seed_option(stream, arguments.seed);
}

void add_stream_options(CLI::App& stream, StreamArguments& arguments) {
    stream.add_option("--mode", arguments.modes, "only these, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    stream
        .add_option("--link", arguments.links,
                    fmt::format("only these: {}", fmt::join(sim::link_names(), ", ")))
        ->type_name("LIST")
        ->check(is_not_empty());
    stream.add_option("--batch", arguments.batches, "pair tests in a batch; default: powers of 4 up to all")
        ->type_name("LIST")
        ->check(is_not_empty());
    stream
        .add_option("--read-back", arguments.read_back,
                    "tests (every result), rays (the nearest hit of each; mixed and resident only) or none;\n"
                    "default: rays for resident, tests for the others")
        ->type_name("WHAT")
        ->check(is_not_empty());
    stream.add_flag("--published", arguments.has_published,
                    "also run the setups of Robert and Schweri, beside their rates");
}

void add_output_options(CLI::App& stream, StreamArguments& arguments) {
    add_report_options(stream, arguments.output);
    stream.add_option("--html", arguments.html, "write one page with all tables and charts (needs gnuplot)")
        ->type_name("FILE")
        ->check(is_not_empty());
    stream
        .add_option("--charts", arguments.chart_folder,
                    "write every chart as SVG and PNG there; made if missing (needs gnuplot)")
        ->type_name("DIR")
        ->check(is_not_empty());
}

study::StreamReport measure(study::StreamOptions& options) {
    Progress progress;
    options.progress = [&](std::string_view phase) { progress.show("stream", phase); };
    return study::run_stream_study(options);
}

int run_stream(const StreamArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    StreamPlan plan = make_stream_plan(arguments);
    const study::StreamReport report = measure(plan.options);
    std::vector<study::OutputFile> files;
    if (plan.html) files.push_back({*plan.html, study::stream_html(report)});
    if (plan.chart_folder) {
        for (const study::AnyChart& chart : study::stream_charts(report)) {
            const auto path = *plan.chart_folder / study::name_of(chart);
            files.push_back({path.string() + ".svg", study::draw(chart, study::ChartFormat::Svg)});
            files.push_back({path.string() + ".png", study::draw(chart, study::ChartFormat::Png)});
        }
    }
    write_report(arguments.output, study::stream_text(report), study::stream_json(report),
                 study::stream_csv(report), std::move(files));
    return exit_done;
}

}  // namespace

void add_stream_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<StreamArguments>();
    CLI::App* stream = app.add_subcommand("stream", stream_description);
    stream->footer(stream_footer);
    stream->get_formatter()->column_width(34);
    add_work_options(*stream, *arguments);
    add_stream_options(*stream, *arguments);
    add_machine_options(*stream, arguments->machine);
    add_output_options(*stream, *arguments);
    stream->callback([arguments, &command] { command = [arguments] { return run_stream(*arguments); }; });
}

}  // namespace rtu::apps
