#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

// Who simulates the points of a sweep: processes of this machine, or those of a cluster. Both start `rtusim
// sweep-worker`, which leaves what a point gave in a journal.

namespace rtu::study {

/// The points that wait, and whom to tell.
struct SweepWork {
    std::filesystem::path program;     ///< of the workers
    std::filesystem::path folder;      ///< of journals and trees
    std::filesystem::path list;        ///< the points, a line each
    std::vector<std::size_t> waiting;  ///< lines of the list; those of one tree stand together
    /// Takes what is new in the journals, and tells the progress.
    std::function<void()> look;
    /// The points that still wait, in the order of their lines.
    std::function<std::vector<std::size_t>()> still_waiting;
    /// Gives a point up.
    std::function<void(std::size_t index, const std::string& error)> give_up;
};

/// Simulates them in `workers` processes of this machine, all of which end when this process does. A point
/// whose process dies is tried three times. Throws Error when a worker cannot go on, because a disk is full
/// say.
void run_local(const SweepWork& work, unsigned workers);

/// How a cluster is used.
struct SlurmOptions {
    std::uint32_t points_per_task = 0;        ///< 0: as many as make at most 1000 tasks, but at least 20
    std::vector<std::string> sbatch_options;  ///< handed to sbatch, as --time=1:00:00
    double poll_seconds = 5;
};

/// Submits the points as an array of tasks to Slurm, and collects what they give; goes on with the array of
/// an earlier process when one is still there. Points that are left, because tasks were killed say, are
/// submitted again, three times in all. Throws Error when Slurm's commands fail.
void run_slurm(const SweepWork& work, const SlurmOptions& options);

/// The array of this folder that Slurm still has, or an empty text.
[[nodiscard]] std::string slurm_job(const std::filesystem::path& folder);

}  // namespace rtu::study
