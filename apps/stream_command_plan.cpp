#include "apps/stream_command_plan.hpp"

#include <algorithm>
#include <vector>

#include "apps/option_values.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/presets.hpp"
#include "study/chart/chart.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;

std::vector<sim::StreamMode> parse_modes(const std::string& text) {
    std::vector<sim::StreamMode> modes;
    if (text.empty()) {
        for (const std::string_view name : sim::stream_mode_names())
            modes.push_back(sim::parse_stream_mode(name));
    }
    for (const std::string& name : parse_list("--mode", text)) modes.push_back(sim::parse_stream_mode(name));
    return modes;
}

std::vector<std::uint64_t> parse_batches(const std::string& text) {
    std::vector<std::uint64_t> batches;
    for (const std::string& part : parse_list("--batch", text)) {
        constexpr std::uint64_t most = std::uint64_t{1} << 40;
        const auto tests = parse_count(part);
        if (!tests || *tests < 1 || *tests > most) {
            throw Error("--batch: expected numbers of tests from 1 to {}, got '{}'", most,
                        model::one_line(part));
        }
        batches.push_back(*tests);
    }
    std::ranges::sort(batches);
    return batches;
}

// Each link, on the machine with the changes that were asked for.
std::vector<study::LinkedMachine> parse_links(const StreamArguments& arguments) {
    std::vector<std::string> names = parse_list("--link", arguments.links);
    if (names.empty()) {
        names = sim::link_names();
        names.erase(names.begin());  // without a link: in every row anyway
    }
    std::vector<study::LinkedMachine> machines;
    for (const std::string& name : names) machines.push_back({name, load(arguments.machine, name).config});
    return machines;
}

study::StreamOptions parse_options(const StreamArguments& arguments) {
    study::StreamOptions options;
    options.scene =
        parse_scenes(arguments.scene.empty() ? std::vector<std::string>{} : std::vector{arguments.scene})
            .front();
    options.pairing = model::parse_pairing_method(arguments.pairing);
    options.edge_identity = model::parse_edge_identity(arguments.edge_identity);
    options.workload = model::parse_workload_kind(arguments.workload);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, {options.scene});
    options.seed = parse_seed(arguments.seed);
    options.ray_count = arguments.ray_count;
    options.pair_count = arguments.pair_count;
    options.modes = parse_modes(arguments.modes);
    if (!arguments.read_back.empty()) options.read_back = sim::parse_read_back(arguments.read_back);
    options.batches = parse_batches(arguments.batches);
    options.preset = arguments.machine.preset;
    options.machines = parse_links(arguments);
    options.has_published = arguments.has_published;
    return options;
}

// The modes that send rays and pairs together have no nearest hit to read back.
void check_read_back(const study::StreamOptions& options) {
    if (options.read_back != sim::ReadBack::Rays) return;
    for (const sim::StreamMode mode : options.modes) {
        if (mode == sim::StreamMode::Direct || mode == sim::StreamMode::Batched)
            throw Error("--read-back rays: expected --mode mixed or resident, got {}", to_string(mode));
    }
}

// Beyond this a run would take hours.
void check_size(const StreamArguments& arguments) {
    constexpr std::uint64_t most = std::uint64_t{1} << 30;
    const std::uint64_t tests = std::uint64_t{arguments.ray_count} * arguments.pair_count;
    if (tests > most) throw Error("--rays and --pairs: expected at most {} tests, got {}", most, tests);
}

void check_outputs(const StreamPlan& plan, const StreamArguments& arguments) {
    std::vector<fs::path> inputs;
    for (const std::string& name : {arguments.scene, arguments.camera, arguments.machine.file}) {
        if (!name.empty()) inputs.emplace_back(name);
    }
    check_report_output(arguments.output, inputs);
    if (plan.html) {
        check_output(*plan.html, inputs);
        for (const std::string& other : {arguments.output.json, arguments.output.csv}) {
            if (!other.empty() && other != "-" && is_same_file(other, *plan.html))
                throw Error("{}: is named by two options", other);
        }
    }
    if (plan.chart_folder) study::check_writable_folder(*plan.chart_folder);
    if (plan.chart_folder || plan.html) study::check_gnuplot();
}

}  // namespace

StreamPlan make_stream_plan(const StreamArguments& arguments) {
    StreamPlan plan;
    check_size(arguments);
    plan.options = parse_options(arguments);
    check_read_back(plan.options);
    plan.html = optional_path(arguments.html);
    plan.chart_folder = optional_path(arguments.chart_folder);
    check_outputs(plan, arguments);
    return plan;
}

}  // namespace rtu::apps
