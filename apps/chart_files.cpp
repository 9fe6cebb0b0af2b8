#include "apps/chart_files.hpp"

#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "model/error.hpp"
#include "study/chart/chart_format.hpp"

namespace rtu::apps {

void add_chart_file_options(CLI::App& command, ChartFiles& files) {
    command.add_option("--html", files.html, "write one page with all tables and charts (needs gnuplot)")
        ->type_name("FILE")
        ->check(is_not_empty());
    command
        .add_option("--charts", files.folder,
                    "write every chart as SVG and PNG there; made if missing (needs gnuplot)")
        ->type_name("DIR")
        ->check(is_not_empty());
}

void check_chart_files(const ChartFiles& files, const ReportOutput& output,
                       const std::vector<std::filesystem::path>& inputs) {
    if (!files.html.empty()) {
        check_output(files.html, inputs);
        for (const std::string& other : {output.json, output.csv}) {
            if (!other.empty() && other != "-" && is_same_file(other, files.html))
                throw Error("{}: is named by two options", files.html);
        }
    }
    if (!files.folder.empty()) study::check_writable_folder(files.folder);
    if (!files.html.empty() || !files.folder.empty()) study::check_gnuplot();
}

void add_charts(const ChartFiles& files, const std::vector<study::AnyChart>& charts,
                std::vector<study::OutputFile>& outputs) {
    if (files.folder.empty()) return;
    for (const study::AnyChart& chart : charts) {
        const auto path = std::filesystem::path(files.folder) / study::name_of(chart);
        outputs.push_back({path.string() + ".svg", study::draw(chart, study::ChartFormat::Svg)});
        outputs.push_back({path.string() + ".png", study::draw(chart, study::ChartFormat::Png)});
    }
}

}  // namespace rtu::apps
