#include "apps/config_command.hpp"

#include <memory>

#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/standard_output.hpp"

namespace rtu::apps {
namespace {

constexpr const char* config_footer =
    "Examples:\n"
    "  rtusim config > machine.toml                        a file to edit, and to give to --config\n"
    "  rtusim config --preset rdna4 --set rtu.count=2      a preset with a change\n"
    "  rtusim config --compare                             all presets side by side\n";

struct ConfigArguments {
    MachineOptions machine;
    bool is_markdown = false;
    bool is_comparison = false;
};

int print_config(const ConfigArguments& arguments) {
    const sim::EffectiveConfig config = load(arguments.machine);
    if (arguments.is_comparison) {
        print_all(sim::presets_markdown());
    } else {
        print_all(arguments.is_markdown ? sim::config_markdown(config) : sim::describe_config(config));
    }
    return exit_done;
}

}  // namespace

void add_config_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<ConfigArguments>();
    CLI::App* config = app.add_subcommand(
        "config",
        "print the machine: every key with its value, unit, range, meaning and source, as TOML that\n"
        "--config reads back");
    config->footer(config_footer);
    add_machine_options(*config, arguments->machine);
    add_link_option(*config, arguments->machine);
    CLI::Option* markdown =
        config->add_flag("--markdown", arguments->is_markdown, "print it as a Markdown table");
    config
        ->add_flag("--compare", arguments->is_comparison,
                   "print all presets side by side, as a Markdown table")
        ->excludes(markdown);
    config->callback([arguments, &command] { command = [arguments] { return print_config(*arguments); }; });
}

}  // namespace rtu::apps
