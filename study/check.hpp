#pragma once

#include <optional>
#include <span>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/traversal.hpp"
#include "model/workload.hpp"
#include "study/oracle/embree_oracle.hpp"
#include "study/oracle/exact_oracle.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

/// One scene's hits held against two independent opinions.
///
/// Reference: the traversal of model/, on the same rays; its hits must be bit-equal and its counts equal.
/// Embree, robust mode: the same primitive, or both a miss (for any-hit rays: both a hit or both a miss).
/// Where they differ the exact rational test decides. It may allow both (a tie: surfaces that touch, a ray
/// exactly through an edge), find Embree wrong, or side with Embree: only that is a mismatch.
class HitChecker {
  public:
    /// `mailbox`: of the machine's rays; it changes counts, and must not change a hit.
    HitChecker(const model::TriangleMesh& mesh, const model::MemoryImage& image,
               model::MailboxOptions mailbox = {})
        : mesh_(mesh), image_(image), mailbox_(mailbox), embree_(mesh) {}

    /// Compares the simulated hits [rays.size()] of a workload, on all cores, and adds to `report()`.
    /// Returns the reference traversal's counts.
    model::TraversalCounts check(const model::Workload& workload,
                                 std::span<const std::optional<model::Hit>> hits);

    [[nodiscard]] const CheckReport& report() const { return report_; }

  private:
    struct Scratch {
        model::TraversalStack stack;
        model::Mailbox mailbox;
    };
    struct Verdict {
        bool is_reference_equal = true;
        bool is_embree_equal = true;
        model::TraversalCounts counts;
    };
    [[nodiscard]] Verdict compare(const model::Ray& ray, model::RayKind kind,
                                  const std::optional<model::Hit>& hit, Scratch& scratch) const;
    void judge(const model::Ray& ray, model::RayKind kind, const std::optional<model::Hit>& hit);

    const model::TriangleMesh& mesh_;
    const model::MemoryImage& image_;
    model::MailboxOptions mailbox_;
    EmbreeOracle embree_;
    CheckReport report_;
};

}  // namespace rtu::study
