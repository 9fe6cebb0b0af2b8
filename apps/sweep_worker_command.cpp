#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "apps/exit_code.hpp"
#include "apps/standard_output.hpp"
#include "apps/sweep_command.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "study/sweep/sweep_journal.hpp"
#include "study/sweep/sweep_point.hpp"
#include "study/sweep/sweep_worker.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;

struct WorkerArguments {
    std::string list;
    std::string journal;  ///< of a worker that takes the points from its standard input
    int parent = 0;
    std::string journals, tasks;  ///< of a task of a cluster
    std::size_t task = 0;
};

// No worker outlives the sweep that it works for.
bool is_tied_to(int parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    return ::getppid() == parent;
}

// Points come as numbers, a line each; each is answered when it is in the journal.
int serve(const WorkerArguments& arguments) try {
    if (!is_tied_to(arguments.parent)) return exit_done;
    study::SweepWorker worker(arguments.list, arguments.journal);
    for (std::size_t point = 0; std::cin >> point;) {
        const bool is_done = worker.run(point);
        print_all(fmt::format("{} {}\n", is_done ? "done" : "failed", point));
        if (!is_done) break;
    }
    return exit_done;
} catch (const Error& error) {
    print_all(fmt::format("error {}\n", model::printable(error.what())));
    return exit_bad_input;
}

std::vector<std::size_t> points_of_task(const fs::path& tasks, std::size_t task) {
    std::ifstream stream(tasks);
    std::string line;
    for (std::size_t i = 0; i <= task; ++i) {
        if (!std::getline(stream, line)) throw Error("{}: expected task {}", tasks.string(), task);
    }
    std::istringstream numbers(line);
    std::vector<std::size_t> points;
    for (std::size_t point = 0; numbers >> point;) points.push_back(point);
    return points;
}

// What a task left before it was interrupted and started again.
std::set<std::string> points_in_journals(const fs::path& folder, const std::string& prefix) {
    std::set<std::string> points;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.path().filename().string().starts_with(prefix)) continue;
        for (const std::string& line : study::read_journal(entry.path(), 0).lines)
            points.insert(study::parse_sweep_result(line).point);
    }
    return points;
}

int run_task(const WorkerArguments& arguments) {
    const std::string prefix =
        fmt::format("{}-{}-", fs::path(arguments.tasks).stem().string(), arguments.task);
    const std::set<std::string> done = points_in_journals(arguments.journals, prefix);
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    const fs::path journal =
        fs::path(arguments.journals) / fmt::format("{}{:x}-{}.journal", prefix, now, ::getpid());
    study::SweepWorker worker(arguments.list, journal);
    for (const std::size_t point : points_of_task(arguments.tasks, arguments.task)) {
        if (done.contains(worker.id(point)) || worker.run(point)) continue;
        const std::string number = fmt::format("{}", arguments.task);
        // A process in which a point failed is replaced; the new one skips what is in the journals.
        ::execl("/proc/self/exe", "rtusim", "sweep-worker", arguments.list.c_str(), "--journals",
                arguments.journals.c_str(), "--tasks", arguments.tasks.c_str(), "--task", number.c_str(),
                nullptr);
        throw Error("cannot start again");
    }
    return exit_done;
}

}  // namespace

void add_sweep_worker_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<WorkerArguments>();
    CLI::App* worker =
        app.add_subcommand("sweep-worker", "simulate points of a sweep, as `rtusim sweep` asks");
    worker->group("");  // not listed
    worker->add_option("LIST", arguments->list, "the points of the sweep")->required();
    CLI::Option* journal = worker->add_option("--journal", arguments->journal, "where results go");
    worker->add_option("--parent", arguments->parent, "process to end with")->needs(journal);
    worker->add_option("--journals", arguments->journals, "folder where results go")->excludes(journal);
    worker->add_option("--tasks", arguments->tasks, "points of each task, a line a task")->excludes(journal);
    worker->add_option("--task", arguments->task, "line of --tasks, from 0")->excludes(journal);
    worker->callback([arguments, &command] {
        command = [arguments] {
            return arguments->journal.empty() ? run_task(*arguments) : serve(*arguments);
        };
    });
}

}  // namespace rtu::apps
