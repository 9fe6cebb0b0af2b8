#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "model/error.hpp"
#include "model/fingerprint.hpp"
#include "study/output_file.hpp"
#include "study/sweep/child_process.hpp"
#include "study/sweep/sweep_executor.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;

constexpr int most_rounds = 3;
constexpr std::size_t most_tasks = 1000;  // what Slurm's MaxArraySize allows by default
constexpr std::size_t least_points = 20;  // starting a task costs about a second

// Named after the folder, so that another process finds it again.
std::string job_name(const fs::path& folder) {
    return "rtusim-" +
           model::hex_digits(model::fingerprint(fs::absolute(folder).lexically_normal().string()));
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// In single quotes, for a shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

// Later rounds have what killed its task, and what stood behind it: fewer points together, in the last round
// as few as there can be tasks.
std::size_t points_of_task(const SlurmOptions& options, std::size_t points, int round) {
    const std::size_t fewest = (points + most_tasks - 1) / most_tasks;
    if (round == most_rounds) return fewest;
    const std::size_t first =
        options.points_per_task > 0 ? options.points_per_task : std::max(fewest, least_points);
    return round == 1 ? first : std::max(fewest, first / 8);
}

// A line for each task, with the points that it simulates.
std::string task_list(const std::vector<std::size_t>& points, std::size_t points_per_task) {
    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_last = i + 1 == points.size() || (i + 1) % points_per_task == 0;
        text += fmt::format("{}{}", points[i], is_last ? '\n' : ' ');
    }
    return text;
}

std::string script(const SweepWork& work, const fs::path& tasks) {
    return fmt::format(
        "#!/bin/sh\nexec {} sweep-worker {} --journals {} --tasks {} --task $SLURM_ARRAY_TASK_ID\n",
        quoted(fs::absolute(work.program).string()), quoted(fs::absolute(work.list).string()),
        quoted(fs::absolute(work.folder).string()), quoted(fs::absolute(tasks).string()));
}

void submit(const SweepWork& work, const SlurmOptions& options, const std::vector<std::size_t>& points,
            int round) {
    const std::size_t per_task = points_of_task(options, points.size(), round);
    const std::size_t task_count = (points.size() + per_task - 1) / per_task;
    const std::string text = task_list(points, per_task);
    const std::string name = model::hex_digits(model::fingerprint(text));
    const fs::path tasks = work.folder / (name + ".tasks"), sbatch = work.folder / (name + ".sbatch");
    const std::vector<OutputFile> files{{tasks, text}, {sbatch, script(work, tasks)}};
    write_files(files);
    std::vector<std::string> command{"sbatch",
                                     "--parsable",
                                     "--requeue",
                                     "--open-mode=append",
                                     "--ntasks=1",
                                     "--job-name=" + job_name(work.folder),
                                     fmt::format("--array=0-{}", task_count - 1),
                                     "--chdir=" + fs::absolute(work.folder).string(),
                                     "--output=task-%a.log"};
    command.insert(command.end(), options.sbatch_options.begin(), options.sbatch_options.end());
    command.push_back(fs::absolute(sbatch).string());
    static_cast<void>(output_of(command));
}

}  // namespace

std::string slurm_job(const fs::path& folder) {
    return first_line(
        output_of({"squeue", "--me", "--noheader", "--format=%A", "--name=" + job_name(folder)}));
}

void run_slurm(const SweepWork& work, const SlurmOptions& options) {
    int round = 0;
    while (true) {
        // The order matters: what an array left is complete only after it has gone.
        const bool is_running = !slurm_job(work.folder).empty();
        work.look();
        if (is_running) {
            std::this_thread::sleep_for(std::chrono::duration<double>(options.poll_seconds));
            continue;
        }
        const std::vector<std::size_t> left = work.still_waiting();
        if (left.empty()) return;
        if (round++ == most_rounds) {
            for (const std::size_t point : left) {
                work.give_up(point, fmt::format("no task of Slurm gave a result, {} times", most_rounds));
            }
            return;
        }
        submit(work, options, left, round);
    }
}

}  // namespace rtu::study
