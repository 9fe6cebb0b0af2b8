#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "study/check.hpp"

namespace rtu::study {

/// The hits of one workload on their way from the machine: counts them, and has them checked in batches with
/// the rays that they belong to, so that neither need fit into memory.
class CheckedHits {
  public:
    /// `checker` may be null: hits are only counted then.
    CheckedHits(const std::string& workload, model::RayKind kind, HitChecker* checker)
        : checker_(checker), batch_{workload, kind, {}, {}} {}

    /// A ray that enters the machine; needed only with a checker.
    void add_ray(const model::Ray& ray) { rays_.push_back(ray); }
    /// The hit of the first ray whose hit was not told yet.
    void add_hit(const std::optional<model::Hit>& hit);
    /// Checks the rest; returns the reference traversal's counts of all rays.
    [[nodiscard]] model::TraversalCounts finish();
    [[nodiscard]] std::uint64_t hit_count() const { return hit_count_; }
    /// Host CPU time that the checks have taken so far.
    [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }

  private:
    void check_batch();

    HitChecker* checker_;
    std::deque<model::Ray> rays_;  // in the machine
    model::Workload batch_;
    std::vector<std::optional<model::Hit>> hits_;  // of the batch
    model::TraversalCounts counts_;
    std::uint64_t hit_count_ = 0;
    double cpu_seconds_ = 0;
};

}  // namespace rtu::study
