#include "apps/report_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/standard_output.hpp"
#include "study/output_file.hpp"
#include "study/report/report_page.hpp"

namespace rtu::apps {
namespace {

constexpr const char* report_description =
    "make one HTML page of results: what limits the machine and what to change, with charts to hover and\n"
    "filter. The page needs no network; a result is known by its content, whatever its name";

constexpr const char* report_footer =
    "Results: what --json of run, pairing, fidelity, stability, methods, precision, area, validate, stream "
    "and\n"
    "sweep wrote, databases of sweeps, and the _box_tests.json of run --image.\n\n"
    "Examples:\n"
    "  rtusim run a.glb --json a.json --image out\n"
    "  rtusim report a.json out/a_box_tests.json --html a.html\n"
    "                                                  one run, and where its rays test many boxes\n"
    "  rtusim report narrow.json wide.json --html both.html\n"
    "                                                  two machines side by side\n"
    "  rtusim report box_unit.db --html sweep.html     a sweep: front, filters, parallel coordinates\n"
    "  rtusim report *.json --html all.html            everything on one page\n";

struct ReportArguments {
    std::vector<std::string> results;
    std::string html;
};

int write_page(const ReportArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    study::check_page_library();
    check_output(arguments.html, {arguments.results.begin(), arguments.results.end()});
    std::vector<study::PageInput> inputs;
    std::string said;
    for (const std::string& result : arguments.results) {
        inputs.push_back(study::load_page_input(result));
        said += fmt::format("{}: {}\n", result, inputs.back().kind);
    }
    const std::string page = study::report_page(inputs);
    study::write_files(std::vector<study::OutputFile>{{arguments.html, page}});
    print_all(fmt::format("{}{}: {} bytes\n", said, arguments.html, page.size()));
    return exit_done;
}

}  // namespace

void add_report_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<ReportArguments>();
    CLI::App* report = app.add_subcommand("report", report_description);
    report->footer(report_footer);
    report->get_formatter()->column_width(34);
    report->add_option("RESULT", arguments->results, "files that other commands wrote, see below")
        ->required()
        ->type_name("")
        ->check(is_not_empty());
    report->add_option("--html", arguments->html, "the page to write")
        ->required()
        ->type_name("FILE")
        ->check(is_not_empty());
    report->callback([arguments, &command] { command = [arguments] { return write_page(*arguments); }; });
}

}  // namespace rtu::apps
