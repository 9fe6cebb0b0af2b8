#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "study/sweep/sqlite.hpp"
#include "study/sweep/sweep_plan.hpp"
#include "study/sweep/sweep_point.hpp"

// The results of sweeps in one SQLite file; its tables are described in docs/sweeps.md.

namespace rtu::study {

/// How far a sweep is.
struct SweepCounts {
    std::uint64_t waiting = 0;
    std::uint64_t done = 0;
    std::uint64_t failed = 0;
    [[nodiscard]] std::uint64_t total() const { return waiting + done + failed; }
};

/// A point that failed, and why.
struct SweepFailure {
    std::string point;
    std::string scene;
    std::string design;
    std::string error;
};

class SweepDatabase {
  public:
    /// Opens the file, or makes it. Throws Error for a file that is there and is no database of sweeps, or
    /// one of another version.
    SweepDatabase(const std::filesystem::path& path, SqlDatabase::Mode mode);

    /// Makes the plan's points of the first pass the present ones: new ones wait, those that are known keep
    /// what they gave. Points of earlier plans stay, without a number.
    void set_plan(const SweepPlan& plan);
    /// Adds points of the second pass, as indices of the plan's points, to the present ones.
    void add_points(const SweepPlan& plan, std::span<const std::size_t> points);
    /// Present points that failed wait once more.
    void retry_failed();
    /// The present points that wait, as indices of the plan's points.
    [[nodiscard]] std::vector<std::size_t> waiting() const;
    [[nodiscard]] SweepCounts counts() const;
    [[nodiscard]] std::vector<SweepFailure> failures() const;

    /// Takes what is new in the journals of `folder`, each line once, whatever was interrupted before.
    /// Returns the points that this completed, done or failed.
    std::vector<SweepResult> import_journals(const std::filesystem::path& folder);
    /// Forgets how far the journals were read that are no longer in `folder`.
    void forget_journals(const std::filesystem::path& folder);
    /// Gives a point up.
    void add_failure(const std::string& point, const std::string& error);
    /// Replaces the table `front`.
    void set_front(const std::vector<std::string>& designs);
    /// Moves everything into the one file, which then can be read anywhere: there is no write-ahead log
    /// beside it until it is written again.
    void close_log();

    [[nodiscard]] const SqlDatabase& sql() const { return database_; }

  private:
    void check_or_make_schema(SqlDatabase::Mode mode);

    SqlDatabase database_;
};

}  // namespace rtu::study
