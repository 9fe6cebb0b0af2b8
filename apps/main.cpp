#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <sstream>
#include <string>
#include <systemc>
#include <vector>

#include "apps/area_command.hpp"
#include "apps/chart_command.hpp"
#include "apps/config_command.hpp"
#include "apps/diff_command.hpp"
#include "apps/exit_code.hpp"
#include "apps/fidelity_command.hpp"
#include "apps/mailbox_command.hpp"
#include "apps/methods_command.hpp"
#include "apps/pairing_command.hpp"
#include "apps/precision_command.hpp"
#include "apps/report_command.hpp"
#include "apps/run_command.hpp"
#include "apps/stability_command.hpp"
#include "apps/standard_output.hpp"
#include "apps/stream_command.hpp"
#include "apps/sweep_command.hpp"
#include "apps/timeline_command.hpp"
#include "apps/trace_command.hpp"
#include "apps/validate_command.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "study/version.hpp"

namespace rtu::apps {
namespace {

constexpr const char* program_description =
    "rtusim - a cycle-approximate simulator of a hardware ray-tracing unit.\n"
    "Per scene it reports ray-box and ray-triangle test counts, cycles and million rays per second (MRPS).";

constexpr const char* program_footer =
    "Examples:\n"
    "  rtusim run                              the built-in scene on the default machine\n"
    "  rtusim run bunny.glb --check            a glTF file, every hit verified\n"
    "  rtusim run --help                       all options of a run\n"
    "  rtusim trace --help                     record, replay and convert rays\n"
    "  rtusim pairing bunny.glb                what triangle pairing does to the hardware\n"
    "  rtusim mailbox sponza.glb               spatial splits, and mailboxes against their duplicates\n"
    "  rtusim fidelity bunny.glb               how far off faster ways of telling MRPS are\n"
    "  rtusim methods                          how fast each ray-triangle test is on this host\n"
    "  rtusim stability                        where ray-triangle methods fail, against exact arithmetic\n"
    "  rtusim precision bunny.glb              the cheapest test and number format for its rays\n"
    "  rtusim chart --html methods.html        the studies of ray-triangle tests as pictures\n"
    "  rtusim sweep machines.toml              many machines, their results in one SQLite file\n"
    "  rtusim diff before.json after.json      what changed between two runs or two sweeps\n"
    "  rtusim area                             gates of the machine, and of sharing a pair's common edge\n"
    "  rtusim validate                         hits, counts and cycles against the RTL reference\n"
    "  rtusim stream                           rays and triangles over a host link, without a BVH\n"
    "  rtusim timeline --json t.json           what units and rays do in each cycle, for Perfetto\n"
    "  rtusim report run.json --html run.html  one page with findings and charts of results\n"
    "  rtusim config --preset default          every parameter with unit, meaning and source\n\n"
    "Exit codes: 0 done; 1 bad input; 2 wrong usage; 3 failed check or internal error.";

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
    if (!app.get_subcommands().empty()) return error.what();
    const std::vector<std::string> rest = app.remaining();
    std::vector<std::string> names;
    for (const CLI::App* command :
         app.get_subcommands([](const CLI::App* listed) { return !listed->get_group().empty(); }))
        names.push_back(command->get_name());
    const std::string last = names.back();
    names.pop_back();
    const std::string expected = fmt::format("expected a command, {} or {}", fmt::join(names, ", "), last);
    return rest.empty() ? expected : fmt::format("{}, got '{}'", expected, rest.front());
}

int report_usage(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help and --version
        std::ostringstream text;
        app.exit(error, text, text);
        print_all(text.str());
        return exit_done;
    }
    print_error(model::printable(usage_error(app, error)) + " (see rtusim --help)");
    return exit_usage;
}

int guarded(const std::function<int()>& command) {
    try {
        return command();
    } catch (const Error& error) {
        print_error(model::printable(error.what()));  // it may quote anything that was typed
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        print_error("not enough memory for this scene, resolution and machine");
        return exit_bad_input;
    } catch (const std::exception& error) {
        print_error(fmt::format("internal error, please report it: {}", error.what()));
        return exit_internal;
    }
}

int run_cli(int argc, char** argv) {
    CLI::App app{program_description, "rtusim"};
    app.footer(program_footer);
    app.set_version_flag("--version", fmt::format("rtusim {}", study::version()),
                         "print the version and exit");
    app.require_subcommand(1);
    std::function<int()> command;
    add_run_command(app, command);
    add_trace_command(app, command);
    add_pairing_command(app, command);
    add_fidelity_command(app, command);
    add_mailbox_command(app, command);
    add_methods_command(app, command);
    add_stability_command(app, command);
    add_precision_command(app, command);
    add_chart_command(app, command);
    add_sweep_command(app, command);
    add_sweep_worker_command(app, command);
    add_diff_command(app, command);
    add_area_command(app, command);
    add_validate_command(app, command);
    add_stream_command(app, command);
    add_timeline_command(app, command);
    add_report_command(app, command);
    add_config_command(app, command);
    return guarded([&] {
        try {
            app.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            return report_usage(app, error);
        }
        return command();
    });
}

}  // namespace
}  // namespace rtu::apps

int sc_main(int argc, char** argv) { return rtu::apps::run_cli(argc, argv); }

// libsystemc has a main() too, but that one prints a banner before sc_main() could ask it not to.
int main(int argc, char** argv) {
    ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
    return sc_core::sc_elab_and_sim(argc, argv);
}
