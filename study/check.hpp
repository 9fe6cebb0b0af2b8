#pragma once

#include <optional>
#include <span>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/traversal.hpp"
#include "model/workload.hpp"
#include "study/embree_oracle.hpp"
#include "study/exact_oracle.hpp"
#include "study/run_report.hpp"

namespace rtu::study {

/// How far from the exact answer a binary32 test may be: this many units in the last place of the largest
/// coordinate, seen from the ray's origin, of the triangles in question. Every such test starts by rounding
/// those.
inline constexpr int neighbour_ulps = 4;

/// One scene's hits held against two independent opinions.
///
/// Reference: the traversal of model/, on the same rays; its hits must be bit-equal and its counts equal.
/// Embree, robust mode: the same primitive, or both a miss (for any-hit rays: both a hit or both a miss).
/// Where they differ the exact rational test decides. It may allow both (a tie: surfaces that touch, a ray
/// exactly through an edge) or find Embree wrong. When it sides with Embree, the simulated answer is a
/// neighbour if it lies on another triangle that the ray meets at Embree's distance, or is the exact answer
/// of a ray that runs beside this one, both within `neighbour_ulps`: no binary32 test can tell on which side
/// of an edge a ray passes, or which of two surfaces closer than that it meets first. A leak is no neighbour:
/// beside it the surface is met. A neighbour is still a mismatch; it is counted
/// apart as well, so that a reader can tell rounding from error.
class HitChecker {
  public:
    HitChecker(const model::TriangleMesh& mesh, const model::MemoryImage& image)
        : mesh_(mesh), image_(image), embree_(mesh) {}

    /// Compares the simulated hits [rays.size()] of a workload, on all cores, and adds to `report()`.
    /// Returns the reference traversal's counts.
    model::TraversalCounts check(const model::Workload& workload,
                                 std::span<const std::optional<model::Hit>> hits);

    [[nodiscard]] const CheckReport& report() const { return report_; }

  private:
    struct Verdict {
        bool is_reference_equal = true;
        bool is_embree_equal = true;
        model::TraversalCounts counts;
    };
    [[nodiscard]] Verdict compare(const model::Ray& ray, model::RayKind kind,
                                  const std::optional<model::Hit>& hit, model::Traversal& scratch) const;
    [[nodiscard]] bool is_at_same_distance(const model::Ray& ray, const model::Hit& a,
                                           const model::Hit& b) const;
    [[nodiscard]] bool is_right_beside(const model::Ray& ray, model::RayKind kind,
                                       const std::optional<model::Hit>& hit, const ExactHits& exact) const;
    void judge(const model::Ray& ray, model::RayKind kind, const std::optional<model::Hit>& hit);

    const model::TriangleMesh& mesh_;
    const model::MemoryImage& image_;
    EmbreeOracle embree_;
    CheckReport report_;
};

}  // namespace rtu::study
