#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "study/output_file.hpp"

namespace rtu::apps {

/// Where a study's report goes, word for word as on the command line; empty strings were not given.
struct ReportOutput {
    std::string json;  ///< "-": standard output, in place of the text
    std::string csv;
};

/// Adds --json and --csv.
void add_report_options(CLI::App& command, ReportOutput& output);

/// Throws Error unless both files can be written, are two, and replace none of `inputs`.
void check_report_output(const ReportOutput& output, const std::vector<std::filesystem::path>& inputs);

/// Writes all files, `files` among them, or none, then prints the text, or the JSON if that was asked for.
/// Throws Error.
void write_report(const ReportOutput& output, const std::string& text, const std::string& json,
                  const std::string& csv, std::vector<study::OutputFile> files = {});

}  // namespace rtu::apps
