#include "apps/diff_command.hpp"

#include <memory>
#include <string>

#include "apps/exit_code.hpp"
#include "apps/standard_output.hpp"
#include "study/report/result_diff.hpp"

namespace rtu::apps {
namespace {

constexpr const char* diff_footer =
    "Host times are left out. Nothing that is simulated is random, so every change is real; it is called\n"
    "significant when it is by more than the tolerance. Of two sweeps the same designs are compared; the\n"
    "sign test tells how likely equal chances of up and down would split the rows so unevenly.\n"
    "Exit code 0: nothing significant; 3: something is, or a row is in one of them only.\n\n"
    "Examples:\n"
    "  rtusim diff before.json after.json                 of `rtusim run --json`\n"
    "  rtusim diff main.db branch.db --tolerance 1        of `rtusim sweep`\n";

struct DiffArguments {
    std::string before, after;
    double tolerance_percent = 0.5;
};

int print_diff(const DiffArguments& arguments) {
    const study::ResultSet before = study::load_result(arguments.before),
                           after = study::load_result(arguments.after);
    const study::ResultDiff diff = study::compare(before, after, arguments.tolerance_percent);
    print_all(study::diff_text(diff, before.is_sweep, arguments.tolerance_percent));
    return diff.is_significant() ? exit_internal : exit_done;
}

}  // namespace

void add_diff_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<DiffArguments>();
    CLI::App* diff = app.add_subcommand("diff", "tell what changed between two runs or two sweeps");
    diff->footer(diff_footer);
    diff->add_option("A", arguments->before, "a report in JSON, or a database of sweeps")
        ->required()
        ->type_name("");
    diff->add_option("B", arguments->after, "the same kind, to compare with it")->required()->type_name("");
    diff->add_option("--tolerance", arguments->tolerance_percent, "a larger change is significant")
        ->type_name("PERCENT")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    diff->callback([arguments, &command] { command = [arguments] { return print_diff(*arguments); }; });
}

}  // namespace rtu::apps
