#include "apps/trace_jobs.hpp"

#include <fmt/format.h>

#include <optional>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/standard_output.hpp"
#include "model/error.hpp"
#include "study/text_table.hpp"
#include "study/trace_tools.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;
using traces::WorkloadCount;

void print_written(const fs::path& file, const std::vector<WorkloadCount>& workloads) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    print_all(fmt::format("{}: {}{}\n\n{}", file.string(), study::total_rays(workloads),
                          error ? "" : ", " + study::byte_size(bytes), study::workload_counts(workloads)));
}

// What the damaged trace had and the new one has not.
std::string losses(const traces::Recovery& recovery) {
    if (!recovery.expected) return "How many rays are missing is not known: its end is lost.\n";
    std::string text;
    for (const WorkloadCount& expected : *recovery.expected) {
        std::uint64_t saved = 0;
        for (const WorkloadCount& workload : recovery.workloads) {
            if (workload.name == expected.name) saved = workload.ray_count;
        }
        if (saved == expected.ray_count) continue;
        text +=
            fmt::format("Missing: {} of the {} rays of '{}'.\n", study::grouped(expected.ray_count - saved),
                        study::grouped(expected.ray_count), expected.name);
    }
    return text.empty() ? "No ray is missing.\n" : text;
}

}  // namespace

int record_trace(const RecordArguments& arguments) {
    RunArguments run = arguments.run;
    if (!arguments.scene.empty()) run.scenes = {arguments.scene};
    RunPlan plan = make_run_plan(run);
    check_output(arguments.output, plan.inputs);
    const ThreadLimit limit(plan.threads);
    const study::SceneSource& scene = plan.scenes.front();
    std::vector<WorkloadCount> workloads;
    {
        Progress progress;
        plan.options.progress = [&](std::string_view phase) { progress.show(scene.name(), phase); };
        workloads = study::record_trace(
            plan.options, scene, arguments.output,
            arguments.has_visits ? traces::TraceContent::Visits : traces::TraceContent::Rays);
    }
    print_written(arguments.output, workloads);
    return exit_done;
}

int print_trace_info(const InspectArguments& arguments) {
    const traces::TraceSurvey survey = traces::survey_trace(arguments.file);
    print_all(study::describe_trace(survey, arguments.file));
    if (survey.fault) throw Error("{}", *survey.fault);
    return exit_done;
}

int verify_trace(const InspectArguments& arguments) {
    if (arguments.recovered.empty()) {
        const traces::TraceSurvey survey = traces::survey_trace(arguments.file);
        if (survey.fault) throw Error("{}", *survey.fault);
        print_all(fmt::format("{}: no fault in {} and {} blocks\n", arguments.file,
                              study::total_rays(survey.workloads), study::grouped(survey.block_count)));
        return exit_done;
    }
    check_output(arguments.recovered, {arguments.file});
    const traces::Recovery recovery = traces::recover_trace(arguments.file, arguments.recovered);
    print_written(arguments.recovered, recovery.workloads);
    print_all(losses(recovery));
    if (!recovery.has_header) print_all("The header is lost: the new trace is tied to no scene.\n");
    return exit_done;
}

int convert_rays(const ConvertArguments& arguments) {
    study::Conversion conversion;
    conversion.input = parse_ray_input(arguments.input, arguments.from, arguments.kind, false);
    conversion.input.import.workload = arguments.name;
    if (!traces::is_workload_name(arguments.name)) {
        throw Error("--name: expected 1 to {} letters, digits, '_', '-' and '.', got '{}'",
                    traces::name_bytes, arguments.name);
    }
    conversion.output = arguments.output;
    conversion.output_format = arguments.to.empty() ? traces::format_of_output(arguments.output)
                                                    : traces::parse_ray_format(arguments.to);
    conversion.only_workload = arguments.workload.empty() ? std::nullopt : std::optional(arguments.workload);
    std::vector<fs::path> inputs{arguments.input};
    if (arguments.is_builtin_scene) {
        conversion.scene = study::SceneSource{};
    } else if (!arguments.scene.empty()) {
        conversion.scene = parse_scenes({arguments.scene}).front();
        inputs.emplace_back(arguments.scene);
    }
    check_output(arguments.output, inputs);
    print_written(arguments.output, study::convert_rays(conversion));
    return exit_done;
}

}  // namespace rtu::apps
