#include "apps/report_output.hpp"

#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/standard_output.hpp"
#include "model/error.hpp"

namespace rtu::apps {

void add_report_options(CLI::App& command, ReportOutput& output) {
    command
        .add_option("--json", output.json, "write the report as JSON; - is standard output, and no text then")
        ->type_name("FILE|-")
        ->check(is_not_empty());
    command.add_option("--csv", output.csv, "write the rows as CSV")
        ->type_name("FILE")
        ->check(is_not_empty());
}

void check_report_output(const ReportOutput& output, const std::vector<std::filesystem::path>& inputs) {
    const bool has_json_file = !output.json.empty() && output.json != "-";
    if (has_json_file) check_output(output.json, inputs);
    if (!output.csv.empty()) check_output(output.csv, inputs);
    if (has_json_file && !output.csv.empty() && is_same_file(output.json, output.csv))
        throw Error("{}: is named by two options", output.csv);
}

void write_report(const ReportOutput& output, const std::string& text, const std::string& json,
                  const std::string& csv, std::vector<study::OutputFile> files) {
    if (!output.json.empty() && output.json != "-") files.push_back({output.json, json});
    if (!output.csv.empty()) files.push_back({output.csv, csv});
    study::write_files(files);
    print_all(output.json == "-" ? json : text);
}

}  // namespace rtu::apps
