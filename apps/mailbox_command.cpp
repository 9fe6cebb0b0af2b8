#include "apps/mailbox_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/chart_files.hpp"
#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/report_output.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "study/mailbox/mailbox_output.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {
namespace {

constexpr const char* mailbox_description =
    "tell what spatial splits are worth to a machine that tests pairs, and what a mailbox saves of the "
    "tests\n"
    "that they repeat: the same rays on trees with and without splits, over several pairings, with "
    "mailboxes\n"
    "of the last pairs, a hashed one, and the classic one of a word a pair in memory";

constexpr const char* mailbox_footer =
    "Examples:\n"
    "  rtusim mailbox                                      the built-in scene\n"
    "  rtusim mailbox sponza.glb --charts out              tests, MRPS and MRPS per gate against the "
    "entries\n"
    "  rtusim mailbox a.glb --pairings none,sa_exchange    other pairings; the first is what others are\n"
    "                                                      compared with\n"
    "  rtusim mailbox a.glb --set bvh.split_budget_percent=100\n"
    "                                                      up to twice as many leaves as pairs\n"
    "  rtusim mailbox a.glb --json - | jq '.rows[] | select(.entries == 8) | .mrps'\n\n"
    "bvh.splits and rtu.mailbox are what is varied, and cannot be set.\n";

struct MailboxArguments {
    std::vector<std::string> scenes;
    MachineOptions machine;
    std::string pairings = "window:2,sa_exchange";
    std::string entries = "1,2,4,8,16";
    std::string workloads = "primary,shadow,diffuse";
    std::string resolution = "128x128";
    std::string camera;
    std::string seed = "1";
    unsigned threads = 0;
    ReportOutput output;
    std::string folder;
};

void add_options(CLI::App& mailbox, MailboxArguments& arguments) {
    add_scenes_option(mailbox, arguments.scenes);
    add_machine_options(mailbox, arguments.machine);
    mailbox.add_option("--pairings", arguments.pairings, "METHODs as in `run`; the first is the baseline")
        ->type_name("LIST")
        ->capture_default_str();
    mailbox.add_option("--entries", arguments.entries, "of mailboxes of the last pairs, 1 to 16 each")
        ->type_name("LIST")
        ->capture_default_str();
    add_workloads_option(mailbox, arguments.workloads);
    add_resolution_option(mailbox, arguments.resolution);
    add_camera_option(mailbox, arguments.camera);
    add_seed_option(mailbox, arguments.seed);
    add_report_options(mailbox, arguments.output);
    mailbox.add_option("--charts", arguments.folder, "draw every chart into this folder, as SVG and PNG")
        ->type_name("DIR")
        ->check(is_not_empty());
    add_threads_option(mailbox, arguments.threads);
}

std::vector<std::uint32_t> parse_entries(const std::string& text) {
    std::vector<std::uint32_t> entries;
    for (const std::string& word : parse_list("--entries", text)) {
        const std::optional<std::uint64_t> number = parse_count(word);
        if (!number || *number < 1 || *number > model::max_mailbox_entries) {
            throw Error("--entries: expected numbers from 1 to {}, got '{}'", model::max_mailbox_entries,
                        model::one_line(word));
        }
        entries.push_back(std::uint32_t(*number));
    }
    std::ranges::sort(entries);
    if (entries.empty() || std::ranges::adjacent_find(entries) != entries.end()) {
        throw Error("--entries: expected every number once, got '{}'", model::one_line(text));
    }
    return entries;
}

std::vector<model::PairingMethod> parse_pairings(const std::string& text) {
    std::vector<model::PairingMethod> methods;
    for (const std::string& word : parse_list("--pairings", text)) {
        methods.push_back(model::parse_pairing_method(word));
    }
    if (methods.empty()) throw Error("--pairings: expected a method");
    return methods;
}

// What the study varies must not look as if it had been chosen.
sim::Config machine_of(const MachineOptions& machine) {
    const sim::EffectiveConfig effective = load(machine);
    const sim::Config& config = effective.config;
    if (config.bvh.splits != sim::SplitKind::Object || config.rtu.mailbox.is_on()) {
        throw Error("bvh.splits and rtu.mailbox are what this study varies: expected them not to be set");
    }
    if (config.bvh.max_leaf_pairs != 1) {
        throw Error("bvh.max_leaf_pairs: expected 1, as spatial splits need, got {}",
                    config.bvh.max_leaf_pairs);
    }
    return config;
}

study::MailboxStudyOptions options_of(const MailboxArguments& arguments) {
    study::MailboxStudyOptions options;
    options.config = machine_of(arguments.machine);
    options.scenes = parse_scenes(arguments.scenes);
    options.pairings = parse_pairings(arguments.pairings);
    options.entries = parse_entries(arguments.entries);
    options.workloads = parse_workloads(arguments.workloads);
    options.resolution = parse_resolution(arguments.resolution);
    options.seed = parse_seed(arguments.seed);
    options.camera_file = optional_path(arguments.camera);
    check_cameras(options.camera_file, options.scenes);
    check_scene_names(options.scenes);
    return options;
}

int run_mailbox(const MailboxArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::MailboxStudyOptions options = options_of(arguments);
    const auto inputs = input_files(options.scenes, {arguments.camera, arguments.machine.file});
    const ChartFiles charts{"", arguments.folder};
    check_report_output(arguments.output, inputs);
    check_chart_files(charts, arguments.output, inputs);
    const ThreadLimit limit(arguments.threads);
    Progress progress;
    options.progress = [&](std::string_view scene, std::string_view phase) { progress.show(scene, phase); };
    const study::MailboxReport report = study::run_mailbox_study(options);
    std::vector<study::OutputFile> files;
    add_charts(charts, study::mailbox_charts(report), files);
    write_report(arguments.output, study::mailbox_text(report), study::mailbox_json(report),
                 study::mailbox_csv(report), files);
    return exit_done;
}

}  // namespace

void add_mailbox_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<MailboxArguments>();
    CLI::App* mailbox = app.add_subcommand("mailbox", mailbox_description);
    mailbox->footer(mailbox_footer);
    mailbox->get_formatter()->column_width(34);
    add_options(*mailbox, *arguments);
    mailbox->callback([arguments, &command] { command = [arguments] { return run_mailbox(*arguments); }; });
}

}  // namespace rtu::apps
