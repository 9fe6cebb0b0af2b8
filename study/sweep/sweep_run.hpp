#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/sweep/sweep_database.hpp"
#include "study/sweep/sweep_executor.hpp"
#include "study/sweep/sweep_front.hpp"
#include "study/sweep/sweep_plan.hpp"

namespace rtu::study {

/// How far a sweep is, and how fast.
struct SweepProgress {
    std::string phase;  ///< what is prepared; empty once points are simulated
    SweepCounts points;
    double points_per_second = 0;  ///< of this run
    double seconds_left = 0;       ///< 0: not known
    std::string best;              ///< of the first objective; empty when no point is done
};

enum class SweepExecutor : std::uint8_t { Local, Slurm };

struct SweepOptions {
    std::filesystem::path database;
    std::filesystem::path program;  ///< this one: the workers are started from it
    SweepExecutor executor = SweepExecutor::Local;
    unsigned workers = 0;  ///< 0: as many as there are cores, and as have their memory
    SlurmOptions slurm;
    bool retries_failed = false;
    std::function<void(const SweepProgress&)> progress;  ///< may be empty
};

/// What a sweep has come to.
struct SweepOutcome {
    SweepCounts points;
    std::uint64_t simulated = 0;  ///< of those, by this run
    double seconds = 0;           ///< of the host, for this run
    unsigned workers = 0;         ///< 0: of a cluster, or none were needed
    std::vector<SweepFailure> failures;
    std::vector<RatedDesign> front;
    SweepConfirmation confirmation;  ///< of a sweep of estimates
};

/// Simulates the points of the plan that are not in the database yet, and finds the front of the objectives.
/// Whenever it is interrupted, another call finishes. Beside the database there is a folder, DATABASE.work,
/// until all points are done or given up. Throws Error for a database that another process works on or that
/// cannot be written, and as prepare_tree() and the executors do.
[[nodiscard]] SweepOutcome run_sweep(const SweepPlan& plan, const SweepOptions& options);

/// What a sweep will take, from simulations of some designs with few rays.
struct SweepEstimate {
    double cpu_seconds = 0;          ///< for all points
    unsigned workers = 0;            ///< as run_sweep() would start
    std::uint64_t worker_bytes = 0;  ///< of host memory, for each
};

/// Times at most three designs a scene. Throws as run_sweep() does.
[[nodiscard]] SweepEstimate estimate_sweep(const SweepPlan& plan, unsigned workers);

}  // namespace rtu::study
