#include "study/sweep/sweep_run.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>

#include "model/error.hpp"
#include "model/fingerprint.hpp"
#include "study/output_file.hpp"
#include "study/sweep/sweep_folder.hpp"
#include "study/sweep/sweep_memory.hpp"
#include "study/sweep/sweep_tree.hpp"
#include "study/sweep/sweep_worker.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class SweepRun {
  public:
    SweepRun(const SweepPlan& plan, const SweepOptions& options)
        : plan_(plan),
          options_(options),
          folder_(options.database),
          database_(options.database, SqlDatabase::Mode::ReadWrite) {}

    SweepOutcome run() {
        check_cluster();
        database_.forget_journals(folder_.path());
        database_.set_plan(plan_);
        database_.import_journals(folder_.path());
        if (options_.retries_failed) database_.retry_failed();
        const std::vector<std::size_t> waiting = in_tree_order(database_.waiting());
        if (!waiting.empty()) simulate(waiting);
        if (plan_.file.fidelity != FidelityLevel::Cycle) refine_front();
        return finish();
    }

  private:
    // Points that an array of tasks still works on must not be started here too.
    void check_cluster() const {
        bool has_tasks = false;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            has_tasks = has_tasks || entry.path().extension() == ".tasks";
        }
        if (!has_tasks || options_.executor == SweepExecutor::Slurm) return;
        const std::string job = slurm_job(folder_.path());
        if (job.empty()) return;
        throw Error(
            "{}: Slurm still has job {} of this sweep: cancel it (scancel {}), or use --executor slurm",
            options_.database.string(), job, job);
    }

    // Simulates every ray of the designs that may be on the front, until none of them is an estimate.
    void refine_front() {
        while (true) {
            std::vector<std::size_t> points;
            for (const std::string& id :
                 front_to_confirm(rated_designs(database_.sql(), plan_.file.objectives), confirmed_,
                                  plan_.file.objectives)) {
                confirmed_.insert(id);
                const std::size_t design = design_index(id);
                for (std::size_t scene = 0; scene < plan_.scenes.size(); ++scene)
                    points.push_back(plan_.cycle_point(scene, design));
            }
            if (points.empty()) return;
            database_.add_points(plan_, points);
            if (options_.retries_failed) database_.retry_failed();
            const std::vector<std::size_t> waiting = in_tree_order(database_.waiting());
            if (!waiting.empty()) simulate(waiting);
        }
    }

    [[nodiscard]] std::size_t design_index(const std::string& id) const {
        return std::size_t(std::ranges::find(plan_.designs, id, &SweepDesign::id) - plan_.designs.begin());
    }

    [[nodiscard]] std::vector<std::size_t> in_tree_order(std::vector<std::size_t> points) const {
        std::ranges::stable_sort(points, {}, [&](std::size_t point) { return plan_.points[point].tree; });
        return points;
    }

    void simulate(const std::vector<std::size_t>& waiting) {
        prepare(waiting);
        const std::string text = point_list(plan_);
        const fs::path list = folder_.path() / (model::hex_digits(model::fingerprint(text)) + ".points");
        const OutputFile file{list, text};
        write_files({&file, 1});
        pass_start_ = Clock::now();
        if (start_ == Clock::time_point{}) start_ = pass_start_;
        counts_ = database_.counts();
        done_before_ = counts_.done + counts_.failed;
        find_best("");
        const SweepWork work{options_.program,
                             folder_.path(),
                             list,
                             waiting,
                             [this] { look(); },
                             [this] { return database_.waiting(); },
                             [this](std::size_t point, const std::string& error) {
                                 database_.add_failure(plan_.points[point].id, error);
                                 count(true);
                             }};
        if (options_.executor == SweepExecutor::Slurm) return run_slurm(work, options_.slurm);
        workers_ = worker_count(options_.workers, waiting.size(), worker_bytes(waiting));
        run_local(work, workers_);
    }

    void prepare(const std::vector<std::size_t>& waiting) {
        std::set<std::string> prepared;
        for (const std::size_t index : waiting) {
            const SweepPoint& point = plan_.points[index];
            if (!prepared.insert(point.tree).second) continue;
            tell({fmt::format("{}: recording {}", plan_.scenes[point.scene].name,
                              point.level == FidelityLevel::Cycle ? "traversals" : "rays"),
                  {},
                  0,
                  0,
                  {}});
            prepare_tree(run_options(plan_, point), plan_.file.inputs[point.scene].scene, content_of(point),
                         folder_.path(), point.tree);
        }
    }

    [[nodiscard]] std::uint64_t worker_bytes(const std::vector<std::size_t>& waiting) const {
        std::map<std::string, std::uint64_t> trees;
        std::uint64_t most = 0;
        for (const std::size_t index : waiting) {
            const SweepPoint& point = plan_.points[index];
            const auto [tree, is_new] = trees.try_emplace(point.tree, 0);
            if (is_new) tree->second = tree_memory_bytes(folder_.path(), point.tree);
            most = std::max(most, tree->second + machine_bytes(plan_.designs[point.design].config));
        }
        return most;
    }

    void look() {
        for (const SweepResult& result : database_.import_journals(folder_.path())) {
            ++simulated_;
            count(!result.error.empty());
            if (result.error.empty()) find_best(result.point);
        }
        const double seconds = seconds_since(pass_start_);
        const double rate = double(counts_.done + counts_.failed - done_before_) / seconds;
        tell({{}, counts_, rate, rate > 0 ? double(counts_.waiting) / rate : 0.0, best_text()});
    }

    void count(bool is_failure) {
        --counts_.waiting;
        ++(is_failure ? counts_.failed : counts_.done);
    }

    // Looks for a better value of the first objective than the best so far, in one point or (empty) in all.
    void find_best(const std::string& point) {
        const SweepObjective& objective = plan_.file.objectives.front();
        SqlStatement select = database_.sql().prepare(
            fmt::format("SELECT {0}, number FROM results WHERE workload = 'total' AND number IS NOT NULL AND "
                        "{0} IS NOT NULL"
                        " {2} ORDER BY {0} {1} LIMIT 1",
                        sql_name(objective.column), objective.is_maximised ? "DESC" : "ASC",
                        point.empty() ? "" : "AND point = ?1"));
        if (!point.empty()) select.bind(1, point);
        if (!select.next()) return;
        if (best_ && !objective.is_better(select.real(0), best_->value)) return;
        best_ = {select.real(0), std::size_t(select.integer(1))};
    }

    [[nodiscard]] std::string best_text() const {
        if (!best_) return {};
        const SweepPoint& point = plan_.points[best_->point];  // of either pass
        return fmt::format("{} {:.4g} ({}, design {})", plan_.file.objectives.front().name(), best_->value,
                           plan_.scenes[point.scene].name, plan_.designs[point.design].id);
    }

    void tell(const SweepProgress& progress) const {
        if (options_.progress) options_.progress(progress);
    }

    SweepOutcome finish() {
        SweepOutcome outcome;
        outcome.points = database_.counts();
        outcome.simulated = simulated_;
        outcome.seconds = start_ == Clock::time_point{} ? 0.0 : seconds_since(start_);
        outcome.workers = workers_;
        outcome.failures = database_.failures();
        std::vector<RatedDesign> rated = rated_designs(database_.sql(), plan_.file.objectives);
        std::erase_if(rated, &RatedDesign::is_estimate);
        outcome.front = pareto_front(std::move(rated), plan_.file.objectives);
        outcome.confirmation = confirmation(database_.sql());
        std::vector<std::string> designs;
        for (const RatedDesign& design : outcome.front) designs.push_back(design.id);
        database_.set_front(designs);
        folder_.remove_journals();
        database_.forget_journals(folder_.path());
        database_.close_log();
        folder_.remove();
        return outcome;
    }

    const SweepPlan& plan_;
    const SweepOptions& options_;
    SweepFolder folder_;
    SweepDatabase database_;
    struct Best {
        double value = 0;
        std::size_t point = 0;
    };
    Clock::time_point start_{}, pass_start_{};
    std::set<std::string> confirmed_;
    SweepCounts counts_;
    std::optional<Best> best_;
    std::uint64_t done_before_ = 0;
    std::uint64_t simulated_ = 0;
    unsigned workers_ = 0;
};

}  // namespace

SweepOutcome run_sweep(const SweepPlan& plan, const SweepOptions& options) {
    return SweepRun(plan, options).run();
}

}  // namespace rtu::study
