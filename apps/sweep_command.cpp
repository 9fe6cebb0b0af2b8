#include "apps/sweep_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/standard_output.hpp"
#include "apps/sweep_progress.hpp"
#include "model/error.hpp"
#include "study/output_file.hpp"
#include "study/sweep/sweep_export.hpp"
#include "study/sweep/sweep_figures.hpp"
#include "study/sweep/sweep_run.hpp"
#include "study/sweep/sweep_text.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* sweep_description =
    "simulate many machines: what a sweep file names, every combination once, into one SQLite file";

constexpr const char* sweep_footer =
    "A sweep file, in TOML (docs/sweeps.md describes all of it):\n"
    "  scenes = [\"bunny.glb\"]                       files relative to this one, or \"builtin\"\n"
    "  workloads = [\"primary\", \"diffuse\"]\n"
    "  objectives = [\"mrps\", \"min l1.size_bytes\"]   their Pareto front is what is looked for\n"
    "  constraints = [\"rtu.box.boxes_per_cycle >= bvh.width\"]\n"
    "  [axes]                                       keys as `rtusim config` prints them\n"
    "  rtu.box.boxes_per_cycle = [1, 2, 4, 8]\n"
    "  l1.size_bytes = { from = 16384, to = 262144, factor = 2 }\n\n"
    "Everything is checked before anything runs. A point that is done is never simulated again: after any\n"
    "interruption, and with more values in the file, the same command goes on. Exit code 3: points "
    "failed.\n\n"
    "Examples:\n"
    "  rtusim sweep boxes.toml --dry-run              the points, and what they would take\n"
    "  rtusim sweep boxes.toml                        into boxes.db\n"
    "  sqlite3 boxes.db 'SELECT scene, \"l1.size_bytes\", mrps FROM results WHERE workload = \"total\"'\n"
    "  rtusim sweep boxes.toml --csv boxes.csv --front front.json\n"
    "  rtusim sweep docs/explorations/units.toml --scenes scenes --charts pictures\n"
    "  rtusim sweep boxes.toml --executor slurm --sbatch=--time=1:00:00\n";

struct SweepArguments {
    std::string file;
    std::string database;  ///< empty: named after the file
    bool is_dry_run = false;
    std::string executor = "local";
    unsigned workers = 0;
    bool retries_failed = false;
    std::string csv, json, columns, points, front;
    std::string scenes, charts;  ///< folders; empty: none
    std::uint32_t points_per_task = 0;
    std::vector<std::string> sbatch_options;
    double poll_seconds = 5;
};

study::SweepOptions options_of(const SweepArguments& arguments, const study::SweepPlan& plan) {
    study::SweepOptions options;
    options.database = arguments.database.empty() ? plan.file.name + ".db" : arguments.database;
    options.program = fs::read_symlink("/proc/self/exe");
    options.executor =
        arguments.executor == "slurm" ? study::SweepExecutor::Slurm : study::SweepExecutor::Local;
    options.workers = arguments.workers;
    options.slurm = {arguments.points_per_task, arguments.sbatch_options, arguments.poll_seconds};
    options.retries_failed = arguments.retries_failed;
    return options;
}

std::vector<fs::path> inputs_of(const SweepArguments& arguments, const study::SweepFile& file) {
    std::vector<fs::path> inputs{arguments.file};
    for (const study::SweepInput& input : file.inputs) {
        if (input.scene.file) inputs.push_back(*input.scene.file);
        if (input.rays) inputs.push_back(input.rays->file);
    }
    if (file.camera_file) inputs.push_back(*file.camera_file);
    return inputs;
}

void check_outputs(const SweepArguments& arguments, const study::SweepOptions& options,
                   const study::SweepFile& file) {
    std::vector<fs::path> taken = inputs_of(arguments, file);
    for (const std::string& name : {options.database.string(), arguments.csv, arguments.json,
                                    arguments.columns, arguments.points, arguments.front}) {
        if (name.empty()) continue;
        check_output(name, taken);
        taken.emplace_back(name);
    }
    if (arguments.charts.empty()) return;
    if (file.charts.empty()) throw Error("--charts: {} asks for no chart", arguments.file);
    study::check_writable_folder(arguments.charts);
    study::check_gnuplot();
}

// Returns the tables of the charts.
std::string write_exports(const SweepArguments& arguments, const study::SweepPlan& plan,
                          const study::SweepOptions& options, const study::SweepOutcome& outcome) {
    const study::SweepDatabase database(options.database, study::SqlDatabase::Mode::ReadOnly);
    std::vector<study::OutputFile> files;
    if (!arguments.csv.empty()) files.push_back({arguments.csv, study::sweep_csv(database.sql())});
    if (!arguments.json.empty()) files.push_back({arguments.json, study::sweep_json(database.sql())});
    if (!arguments.columns.empty())
        files.push_back({arguments.columns, study::sweep_columns(database.sql())});
    if (!arguments.points.empty())
        files.push_back({arguments.points, study::sweep_points_csv(database.sql())});
    if (!arguments.front.empty()) files.push_back({arguments.front, study::front_json(plan, outcome)});
    std::string tables;
    for (const study::SweepChart& chart : plan.file.charts) {
        const auto figures = study::sweep_figures(database.sql(), chart);
        tables += "\n" + study::sweep_figure_table(chart, figures);
        if (arguments.charts.empty()) continue;
        const study::AnyChart picture = study::sweep_picture(chart, figures);
        files.push_back({fs::path(arguments.charts) / (chart.name + ".svg"),
                         study::draw(picture, study::ChartFormat::Svg)});
    }
    study::write_files(files);
    return tables;
}

int sweep(const SweepArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    const study::SweepPlan plan =
        study::make_sweep_plan(study::read_sweep_file(arguments.file, arguments.scenes));
    study::SweepOptions options = options_of(arguments, plan);
    check_outputs(arguments, options, plan.file);
    if (arguments.is_dry_run) {
        print_all(study::sweep_plan_text(plan, study::estimate_sweep(plan, options.workers)));
        return exit_done;
    }
    study::SweepOutcome outcome;
    {
        SweepProgressLine line;
        options.progress = [&](const study::SweepProgress& progress) { line.show(progress); };
        outcome = study::run_sweep(plan, options);
    }
    const std::string tables = write_exports(arguments, plan, options, outcome);
    print_all(study::sweep_text(plan, outcome, options.database.string()) + tables);
    if (outcome.failures.empty()) return exit_done;
    print_error(fmt::format("{} points failed: see the report", outcome.failures.size()));
    return exit_internal;
}

void add_output_options(CLI::App& app, SweepArguments& arguments) {
    const auto add = [&](const char* name, std::string& value, const char* help) {
        app.add_option(name, value, help)->type_name("FILE")->check(is_not_empty());
    };
    add("--output", arguments.database, "the database; default: the sweep file's name with .db, here");
    add("--csv", arguments.csv, "write all rows as CSV");
    add("--json", arguments.json, "write all rows as JSON");
    add("--points", arguments.points, "write one row a point as CSV: flat columns of one type each");
    add("--columns", arguments.columns, "write the same as typed columns, for Parquet");
    add("--front", arguments.front, "write the Pareto front as JSON");
    app.add_option("--charts", arguments.charts,
                   "write the charts of the sweep file as SVG there; made if missing (needs gnuplot)")
        ->type_name("DIR")
        ->check(is_not_empty());
    app.add_option("--scenes", arguments.scenes,
                   "where files that the sweep file names are looked for, when they are not beside it")
        ->type_name("DIR")
        ->check(CLI::ExistingDirectory);
}

void add_executor_options(CLI::App& app, SweepArguments& arguments) {
    app.add_option("--executor", arguments.executor,
                   "local: processes of this machine; slurm: an array of tasks on a cluster")
        ->type_name("NAME")
        ->check(CLI::IsMember({"local", "slurm"}))
        ->capture_default_str();
    app.add_option("--workers", arguments.workers,
                   "processes of this machine; 0: one a core, as memory allows")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option("--points-per-task", arguments.points_per_task,
                   "of a task of the cluster; 0: at most 1000 tasks, at least 20 points each")
        ->type_name("N")
        ->check(CLI::Range(0, 1'000'000))
        ->capture_default_str();
    app.add_option("--sbatch", arguments.sbatch_options, "an option for sbatch; repeatable")
        ->type_name("OPTION")
        ->allow_extra_args(false);
    app.add_option("--poll-seconds", arguments.poll_seconds, "between two looks at the cluster")
        ->type_name("S")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
}

}  // namespace

void add_sweep_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<SweepArguments>();
    CLI::App* sweep_app = app.add_subcommand("sweep", sweep_description);
    sweep_app->footer(sweep_footer);
    sweep_app->get_formatter()->column_width(34);
    sweep_app->add_option("SWEEP", arguments->file, "the sweep file")->required()->type_name("");
    sweep_app->add_flag("--dry-run", arguments->is_dry_run,
                        "print the points with an estimate of time and memory, and run nothing");
    sweep_app->add_flag("--retry-failed", arguments->retries_failed, "simulate points that failed once more");
    add_output_options(*sweep_app, *arguments);
    add_executor_options(*sweep_app, *arguments);
    sweep_app->callback([arguments, &command] { command = [arguments] { return sweep(*arguments); }; });
}

}  // namespace rtu::apps
