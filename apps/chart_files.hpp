#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/report_output.hpp"
#include "study/chart/any_chart.hpp"
#include "study/output_file.hpp"

namespace rtu::apps {

/// Where a study's page and pictures go, word for word as on the command line; empty strings were not given.
struct ChartFiles {
    std::string html;
    std::string folder;
};

/// Adds --html and --charts.
void add_chart_file_options(CLI::App& command, ChartFiles& files);

/// Throws Error unless the page and the folder can be written, the page replaces no input and no other
/// output, and gnuplot is there if anything is to be drawn.
void check_chart_files(const ChartFiles& files, const ReportOutput& output,
                       const std::vector<std::filesystem::path>& inputs);

/// Draws every chart as SVG and PNG into the folder's files; nothing without a folder.
void add_charts(const ChartFiles& files, const std::vector<study::AnyChart>& charts,
                std::vector<study::OutputFile>& outputs);

}  // namespace rtu::apps
